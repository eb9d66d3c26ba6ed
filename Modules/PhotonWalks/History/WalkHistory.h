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
  bool isFront;                 ///< see WalkHistory::isFront
};

/// Photons that left the history or came to it, in any order.
struct PhotonChanges
{
  std::vector<Photon> gone, arrived;

  void add(const PhotonChanges& others)
  {
    gone.insert(gone.end(), others.gone.begin(), others.gone.end());
    arrived.insert(arrived.end(), others.arrived.begin(), others.arrived.end());
  }
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

  Power power(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    return blocks_[place.block].power(place.walkInBlock, photon.bounce);
  }
  /// The hit without its distance.
  Hit hit(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    return blocks_[place.block].hit(place.walkInBlock, photon.bounce);
  }
  /// Whether it arrived on the front. Known of all photons only if they are kept for others, see
  /// WalkBatch.
  bool isFront(const PhotonReference& photon) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    return blocks_[place.block].isFront(place.walkInBlock, photon.bounce);
  }
  /// Where the photon is stored.
  const WalkBlock& blockOf(const PhotonReference& photon, std::uint32_t& walkInBlock) const
  {
    const WalkPlan::Place place = plan_.placeOf(photon.walk);
    walkInBlock = place.walkInBlock;
    return blocks_[place.block];
  }

  /// Calls visit(Photon) for each photon that segments of a walk from `first` on brought, in order.
  template <class Visit>
  void forEachPhotonOf(
    std::size_t block, std::uint32_t walkInBlock, std::uint32_t first, const Visit& visit) const
  {
    visitPhotons(blocks_[block], firstWalkOf(block), walkInBlock, first, visit);
  }
  /// The same for all walks of a block.
  template <class Visit>
  void forEachPhoton(std::size_t block, const Visit& visit) const
  {
    const std::uint32_t firstWalk = firstWalkOf(block);
    for (std::uint32_t walk = 0; walk < blocks_[block].numberOfWalks(); ++walk)
    {
      visitPhotons(blocks_[block], firstWalk, walk, 0, visit);
    }
  }

private:
  template <class Visit>
  static void visitPhotons(const WalkBlock& walks, std::uint32_t firstWalk,
    std::uint32_t walkInBlock, std::uint32_t first, const Visit& visit)
  {
    for (std::uint32_t bounce = first; bounce < walks.size(walkInBlock); ++bounce)
    {
      if (const Hit hit = walks.hit(walkInBlock, bounce))
      {
        visit(Photon{ { firstWalk + walkInBlock, bounce }, hit.id, hit.weights,
          walks.isFront(walkInBlock, bounce) });
      }
    }
  }

  const WalkPlan& plan_;
  const std::vector<WalkBlock>& blocks_;
};

}

#endif
