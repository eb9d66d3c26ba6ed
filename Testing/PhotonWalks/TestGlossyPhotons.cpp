// SPDX-License-Identifier: BSD-3-Clause
#include "Views/GlossyPhotons.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using Arrivals = std::vector<GlossyPhotons::Arrival>;

/// On both sides of some triangles; some come from behind, as far as rounding allows it and farther.
Arrivals randomArrivals(test::RandomVectors& random, std::size_t count)
{
  std::vector<Vector3> normals;
  for (int i = 0; i < 3; ++i)
  {
    normals.push_back(random.direction());
  }
  Arrivals arrivals(count);
  for (GlossyPhotons::Arrival& arrival : arrivals)
  {
    arrival.triangle = static_cast<std::uint32_t>(random.engine() % 3);
    arrival.point.isFront = random.engine() % 2 == 0;
    arrival.point.normal = (arrival.point.isFront ? 1.0 : -1.0) * normals[arrival.triangle];
    arrival.point.position = random.inCube();
    arrival.toLight = (random.direction() + 0.9 * arrival.point.normal).normalized();
    arrival.watts = { random.powerOfTwo(-3, 0), random.powerOfTwo(-3, 0),
      random.powerOfTwo(-3, 0) };
  }
  return arrivals;
}

}

// By the definition. What is taken for 0 is less than rounding; both sums round each term.
TEST(GlossyPhotons, SumPowerTimesBrdf)
{
  test::RandomVectors random(17);
  for (const double exponent : { 0.0, 0.3, 1.0, 7.0, 50.0, 1000.0, 1e6 })
  {
    const PhongLobe lobe(exponent);
    for (const std::size_t count : { 0u, 1u, 7u, 8u, 500u })
    {
      const Arrivals arrivals = randomArrivals(random, count);
      for (const int bands : { 1, 3 })
      {
        const GlossyPhotons photons(lobe, arrivals, bands);
        for (int trial = 0; trial < 20; ++trial)
        {
          // Toward a photon's mirror direction, where narrow lobes matter, or anywhere.
          Eye eye{ random.direction(), trial % 2 == 0 };
          if (trial % 4 < 2 && count > 0)
          {
            const GlossyPhotons::Arrival& one = arrivals[random.engine() % count];
            const Vector3 mirror = mirrored(one.point.normal, -one.toLight);
            eye.position = eye.isFar ? mirror : Vector3(one.point.position + 2 * mirror);
          }
          GlossyPhotons::Bands expected{};
          for (const GlossyPhotons::Arrival& arrival : arrivals)
          {
            const double value = lobe.value(
              arrival.point.normal, arrival.toLight, eye.directionFrom(arrival.point.position));
            for (int band = 0; band < bands; ++band)
            {
              const auto i = static_cast<std::size_t>(band);
              expected[i] += value * arrival.watts[i];
            }
          }
          const GlossyPhotons::Bands sum = photons.towards(eye, lobe);
          for (std::size_t band = 0; band < sum.size(); ++band)
          {
            // A power n of a cosine has n times the error of the cosine.
            ASSERT_NEAR(sum[band], expected[band], (1e-13 + 1e-15 * exponent) * expected[band])
              << "exponent " << exponent << ", " << count << " photons";
          }
        }
      }
    }
  }
}

}
