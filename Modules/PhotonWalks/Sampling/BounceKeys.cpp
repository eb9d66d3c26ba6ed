// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/BounceKeys.h"

namespace irradiance
{

BounceKeys::BounceKeys(const SobolSequence& samples, SampleUse use, std::uint32_t bounces)
  : samples_(&samples)
  , use_(use)
  , bounces_(bounces)
  , replicates_(samples.replicates().count())
  , firstWalk_(samples.replicates().firstWalk())
  , keys_(3 * size())
{
  for (std::size_t i = 0; i < size(); ++i)
  {
    // The first walks are of one replicate each, in their order.
    const auto bounce = static_cast<std::uint32_t>(i / replicates_),
               replicate = static_cast<std::uint32_t>(i % replicates_);
    const SampleKeys keys = samples.keysOf(firstWalk_ + replicate, bounce, use);
    keys_[i] = keys.shuffle;
    keys_[size() + i] = keys.scrambles[0];
    keys_[2 * size() + i] = keys.scrambles[1];
  }
}

}
