// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkHistory_h
#define irradiance_WalkHistory_h

#include "History/WalkBlock.h"
#include "Sampling/WalkPlan.h"

#include <tuple>
#include <vector>

namespace irradiance
{

/// Which photon: that which segment `bounce` of a walk brings to what it hits.
struct PhotonReference
{
  std::uint32_t walk, bounce;

  friend bool operator==(const PhotonReference& a, const PhotonReference& b)
  {
    return a.walk == b.walk && a.bounce == b.bounce;
  }
  friend bool operator<(const PhotonReference& a, const PhotonReference& b)
  {
    return std::tie(a.walk, a.bounce) < std::tie(b.walk, b.bounce);
  }
};

/// A photon and where it arrived.
struct Photon
{
  PhotonReference reference;
  TriangleId id;
  std::array<float, 2> weights; ///< see Hit
};

/// Photons that left the history or came to it, in any order.
struct PhotonChanges
{
  std::vector<Photon> gone, arrived;
};

/// All stored walks. A view: plan and blocks must outlive it.
class WalkHistory
{
public:
  WalkHistory(const WalkPlan& plan, const std::vector<WalkBlock>& blocks)
    : plan_(plan)
    , blocks_(blocks)
  {
  }

  const std::vector<WalkBlock>& blocks() const { return blocks_; }
  std::uint32_t firstWalkOf(std::size_t block) const { return plan_.firstWalkOf(block); }

  Photon photon(const PhotonReference& reference) const
  {
    const WalkPlan::Place place = plan_.placeOf(reference.walk);
    const Hit hit = blocks_[place.block].hit(place.walkInBlock, reference.bounce);
    return { reference, hit.id, hit.weights };
  }
  Power power(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    return blocks_[place.block].power(place.walkInBlock, photon.bounce);
  }
  /// From where the photon flew to where it arrived, in the frame of the stored points: a world
  /// vector but for its length. Rounded to floats.
  Vector3 incoming(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    return blocks_[place.block].vector(place.walkInBlock, photon.bounce);
  }

  /// Prefetches where the walk lies, then what incoming() reads.
  void prefetchPlace(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    blocks_[place.block].prefetchPlace(place.walkInBlock);
  }
  void prefetchPoint(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    blocks_[place.block].prefetchPoint({ place.walkInBlock, photon.bounce });
  }

  /// Calls visit(Photon) for each photon of the stored walks of a block, in order.
  template <class Visit>
  void forEachPhoton(std::size_t block, const Visit& visit) const
  {
    const WalkBlock& walks = blocks_[block];
    for (std::uint32_t walk = 0; walk < walks.numberOfWalks(); ++walk)
    {
      for (std::uint32_t bounce = 0; bounce < walks.size(walk); ++bounce)
      {
        if (const Hit hit = walks.hit(walk, bounce))
        {
          visit(Photon{ { firstWalkOf(block) + walk, bounce }, hit.id, hit.weights });
        }
      }
    }
  }

private:
  const WalkPlan& plan_;
  const std::vector<WalkBlock>& blocks_;
};

}

#endif
