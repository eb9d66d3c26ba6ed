// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BounceKeys_h
#define irradiance_BounceKeys_h

#include "Sampling/SobolSequence.h"

#include <vector>

namespace irradiance
{

/// The sample keys of all walks for one use, at the first bounces: a table by bounce and replicate,
/// for lanes.
class BounceKeys
{
public:
  /// Further bounces are rare.
  static constexpr std::uint32_t kUsualBounces = 32;

  /// `samples` must outlive this. `bounces`: of the table, from 0 on.
  BounceKeys(const SobolSequence& samples, SampleUse use, std::uint32_t bounces = kUsualBounces)
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

  const SobolSequence& samples() const { return *samples_; }
  SampleUse use() const { return use_; }
  std::uint32_t bounces() const { return bounces_; }
  std::uint32_t replicates() const { return replicates_; }
  std::uint32_t firstWalk() const { return firstWalk_; }

  /// By bounce, then by replicate.
  const std::uint32_t* shuffles() const { return keys_.data(); }
  const std::uint32_t* scramblesX() const { return keys_.data() + size(); }
  const std::uint32_t* scramblesY() const { return keys_.data() + 2 * size(); }

private:
  std::size_t size() const { return std::size_t{ bounces_ } * replicates_; }

  const SobolSequence* samples_;
  SampleUse use_;
  std::uint32_t bounces_, replicates_, firstWalk_;
  std::vector<std::uint32_t> keys_;
};

}

#endif
