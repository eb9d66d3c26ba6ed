// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/TailBound.h"

#include "Light/Reflection.h"
#include "Light/Roulette.h"

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
      const auto first = material.reflectance.begin() + static_cast<std::ptrdiff_t>(cell) * bands;
      reflectance_ = std::max(reflectance_, *std::max_element(first, first + bands));
    }
  }
}

std::int64_t TailBound::operator()(
  std::uint32_t walk, std::uint32_t bounce, const Power& first, const Power& incoming) const
{
  // No band carries more than the strongest, and neither reflection nor roulette gives the
  // strongest less if it had more.
  const std::int64_t threshold = rouletteThreshold(first);
  Power strongest{ { incoming.largest() } };
  std::int64_t received = 0;
  while (!strongest.isZero())
  {
    received += strongest[0];
    ++bounce;
    strongest[0] = nearestQuanta(reflectance_ * static_cast<double>(strongest[0]));
    if (strongest[0] < threshold)
    {
      strongest =
        playRoulette(strongest, threshold, samples_.sample(walk, bounce, SampleUse::Roulette)[0]);
    }
  }
  return received;
}

}
