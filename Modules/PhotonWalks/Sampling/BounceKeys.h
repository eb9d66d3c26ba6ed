// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BounceKeys_h
#define irradiance_BounceKeys_h

#include "Sampling/SobolSequence.h"

#include <vector>

namespace irradiance
{

/// The sample keys of all walks at one bounce for one use, which differ by replicate alone.
class BounceKeys
{
public:
  /// `samples` must outlive this.
  BounceKeys(const SobolSequence& samples, std::uint32_t bounce, SampleUse use);

  const SobolSequence& samples() const { return *samples_; }
  std::uint32_t bounce() const { return bounce_; }
  SampleUse use() const { return use_; }
  std::uint32_t replicates() const { return replicates_; }
  std::uint32_t firstWalk() const { return firstWalk_; }

  /// By replicate.
  const std::uint32_t* shuffles() const { return keys_.data(); }
  const std::uint32_t* scramblesX() const { return keys_.data() + replicates_; }
  const std::uint32_t* scramblesY() const { return keys_.data() + std::size_t{ 2 } * replicates_; }

private:
  const SobolSequence* samples_;
  std::uint32_t bounce_;
  SampleUse use_;
  std::uint32_t replicates_, firstWalk_;
  std::vector<std::uint32_t> keys_;
};

}

#endif
