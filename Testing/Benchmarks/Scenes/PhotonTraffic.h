// SPDX-License-Identifier: BSD-3-Clause
#ifndef PhotonTraffic_h
#define PhotonTraffic_h

#include "History/WalkHistory.h"

#include <random>
#include <vector>

/// Photons that come to sets and leave them at random, round by round. At first they all come.
class PhotonTraffic
{
public:
  using Photons = std::vector<irradiance::SegmentRef>;
  struct Step
  {
    std::size_t set;
    irradiance::SegmentRef photon;
  };

  /// `size`: of a set, on average.
  PhotonTraffic(std::size_t sets, std::size_t size)
    : photons_(sets)
  {
    come(sets * size);
  }

  /// That many leave, and others come instead.
  void nextRound(std::size_t count)
  {
    gone_.clear();
    arrived_.clear();
    while (gone_.size() < count)
    {
      const std::size_t set = random_() % photons_.size();
      Photons& photons = photons_[set];
      if (!photons.empty())
      {
        irradiance::SegmentRef& photon = photons[random_() % photons.size()];
        gone_.push_back({ set, photon });
        photon = photons.back();
        photons.pop_back();
      }
    }
    come(count);
  }

  const std::vector<Step>& gone() const { return gone_; }
  const std::vector<Step>& arrived() const { return arrived_; }
  /// What is in each set after the round.
  const std::vector<Photons>& photons() const { return photons_; }

private:
  void come(std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t set = random_() % photons_.size();
      const auto bounce = static_cast<std::uint32_t>(random_() % 6);
      arrived_.push_back({ set, { walk_++, bounce } });
      photons_[set].push_back(arrived_.back().photon);
    }
  }

  std::mt19937_64 random_{ 1 };
  std::uint32_t walk_ = 0;
  std::vector<Step> gone_, arrived_;
  std::vector<Photons> photons_;
};

#endif
