// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/TailBound.h"

#include <algorithm>

namespace irradiance
{

TailBound::TailBound(const SceneObjects& objects, const SobolSequence& samples)
  : samples_(samples)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const Material& material = *objects[object].material;
    const auto bands = static_cast<std::ptrdiff_t>(material.bands);
    for (const std::uint32_t cell : material.cellOfTriangle)
    {
      const auto largest = [&](const std::vector<double>& reflectances) {
        const auto first = reflectances.begin() + static_cast<std::ptrdiff_t>(cell) * bands;
        return *std::max_element(first, first + bands);
      };
      // More than 1 in all if they are of different bands: then powers may grow.
      reflectance_ = std::max(reflectance_,
        largest(material.reflectance) +
          (material.isSpecular() ? largest(material.specularReflectance) : 0));
    }
  }
}

std::int64_t TailBound::operator()(
  std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
{
  // No band ever carries more than the strongest does now.
  std::int64_t received = incoming.largest();
  while (samples_.sample(walk, ++bounce, SampleUse::Survival)[0] < reflectance_)
  {
    received += incoming.largest();
  }
  return received;
}

}
