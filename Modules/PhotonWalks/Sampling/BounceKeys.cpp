// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/BounceKeys.h"

namespace irradiance
{

BounceKeys::BounceKeys(const SobolSequence& samples, std::uint32_t bounce, SampleUse use)
  : samples_(&samples)
  , bounce_(bounce)
  , use_(use)
  , replicates_(samples.replicates().count())
  , firstWalk_(samples.replicates().firstWalk())
  , keys_(3 * std::size_t{ replicates_ })
{
  for (std::uint32_t replicate = 0; replicate < replicates_; ++replicate)
  {
    // The first walks are of one replicate each, in their order.
    const SampleKeys keys = samples.keysOf(firstWalk_ + replicate, bounce, use);
    keys_[replicate] = keys.shuffle;
    keys_[replicates_ + replicate] = keys.scrambles[0];
    keys_[2 * std::size_t{ replicates_ } + replicate] = keys.scrambles[1];
  }
}

}
