// SPDX-License-Identifier: BSD-3-Clause
#include "Views/GlossyPhotons.h"

#include "Geometry/Pi.h"
#include "Sampling/PowUnit.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace irradiance
{

/// The first term of the lobe, without the cosines.
struct GlossyPhotons::Lobe
{
  explicit Lobe(const PhongLobe& lobe)
    : exponent(lobe.exponent())
    , faint(std::exp(-70 * std::log(2.0) / exponent))
    , scale((exponent + 1) / (2 * kPi))
  {
  }

  /// Cosines above `faint`.
  double operator()(double cosine) const
  {
    return scale * powUnit(std::min(cosine, 1.0), exponent);
  }

  double exponent, faint, scale;
};

GlossyPhotons::GlossyPhotons(const PhongLobe& lobe, std::vector<Arrival> arrivals, int bands)
  : watts_(static_cast<std::size_t>(bands))
{
  const auto sideOf = [](const Arrival& a) { return std::tuple(a.triangle, a.point.isFront); };
  std::stable_sort(arrivals.begin(), arrivals.end(),
    [&](const Arrival& a, const Arrival& b) { return sideOf(a) < sideOf(b); });
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    const Arrival& arrival = arrivals[i];
    const Vector3& normal = arrival.point.normal;
    if (i == 0 || sideOf(arrival) != sideOf(arrivals[i - 1]))
    {
      sides_.push_back({ normal, perCosine_.size(), {} });
    }
    const double cosine = std::min(arrival.toLight.dot(normal), 1.0);
    if (!(cosine > 0))
    {
      continue;
    }
    const Vector3 mirror = mirrored(normal, -arrival.toLight);
    for (int k = 0; k < 3; ++k)
    {
      mirrored_[static_cast<std::size_t>(k)].push_back(mirror[k]);
      points_[static_cast<std::size_t>(k)].push_back(arrival.point.position[k]);
    }
    perCosine_.push_back(1 / cosine);
    losses_.push_back(lobe.loss(cosine) / (lobe.meanLoss() * kPi));
    for (std::size_t band = 0; band < watts_.size(); ++band)
    {
      watts_[band].push_back(arrival.watts[band]);
      sides_.back().compensation[band] += arrival.watts[band] * losses_.back();
    }
    sides_.back().end = perCosine_.size();
  }
}

GlossyPhotons::Bands GlossyPhotons::towards(const Eye& eye, const PhongLobe& lobe) const
{
  return eye.isFar ? towardsFar(eye.position, lobe) : towardsNear(eye, lobe);
}

GlossyPhotons::Bands GlossyPhotons::towardsFar(
  const Vector3& direction, const PhongLobe& lobe) const
{
  constexpr std::size_t kTogether = 8; // cosines of photons, as SIMD
  const Lobe first(lobe);
  Bands sum{};
  std::size_t begin = 0;
  for (const Side& side : sides_)
  {
    const double out = std::min(direction.dot(side.normal), 1.0);
    if (out > 0)
    {
      const double loss = lobe.loss(out);
      std::transform(sum.begin(), sum.end(), side.compensation.begin(), sum.begin(),
        [loss](double watts, double part) { return watts + loss * part; });
      const double perOut = 1 / out;
      for (std::size_t i = begin; i < side.end; i += kTogether)
      {
        const std::size_t count = std::min(kTogether, side.end - i);
        double cosines[kTogether] = {};
        for (std::size_t k = 0; k < count; ++k)
        {
          cosines[k] = direction[0] * mirrored_[0][i + k] + direction[1] * mirrored_[1][i + k] +
            direction[2] * mirrored_[2][i + k];
        }
        for (std::size_t k = 0; k < count; ++k)
        {
          if (cosines[k] > first.faint)
          {
            addLobe(i + k, first(cosines[k]) * std::min(perCosine_[i + k], perOut), sum);
          }
        }
      }
    }
    begin = side.end;
  }
  return sum;
}

GlossyPhotons::Bands GlossyPhotons::towardsNear(const Eye& eye, const PhongLobe& lobe) const
{
  const Lobe first(lobe);
  Bands sum{};
  std::size_t i = 0;
  for (const Side& side : sides_)
  {
    for (; i < side.end; ++i)
    {
      const Vector3 toEye = eye.directionFrom({ points_[0][i], points_[1][i], points_[2][i] });
      const double out = std::min(toEye.dot(side.normal), 1.0);
      if (!(out > 0))
      {
        continue;
      }
      const double cosine = toEye.dot(Vector3(mirrored_[0][i], mirrored_[1][i], mirrored_[2][i]));
      const double peak =
        cosine > first.faint ? first(cosine) * std::min(perCosine_[i], 1 / out) : 0.0;
      addLobe(i, peak + losses_[i] * lobe.loss(out), sum);
    }
  }
  return sum;
}

}
