#ifndef irradiance_WalkVerifier_h
#define irradiance_WalkVerifier_h

#include "WalkShooter.h"

#include <optional>
#include <vector>

namespace irradiance
{

/// The first segment of a walk that the motion changed, and its hit in the new frame.
struct StaleSegment
{
  std::uint32_t walkInBlock;
  std::uint32_t bounce;
  Hit hit;
};

/**
 * Says which stored walks changed, and touches nothing. Conservative and exact: after the repair
 * every stored hit is what a cast into the whole new scene finds.
 *
 * Section 3.2 of the paper, sharpened: only the objects that moved are looked at, unless the object
 * that was hit has moved itself.
 */
class WalkVerifier
{
public:
  /// `moved[i]`: the i-th dynamic object has another pose or shape than in the stored frame.
  WalkVerifier(const Scene& scene, const WalkShooter& shooter, const std::vector<bool>& moved)
    : scene_(scene)
    , shooter_(shooter)
    , moved_(moved)
  {
  }

  /// `walk` is the number of the walk, `walkInBlock` its place in the block.
  std::optional<StaleSegment> firstStaleSegment(
    const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk) const;

private:
  bool hasMoved(const Hit& hit) const
  {
    return hit && hit.id.object > 0 && moved_[hit.id.object - 1];
  }
  Hit hitBehindMovedObject(const Ray& ray, const Hit& old, const Hit* hiddenStaticHit) const;

  const Scene& scene_;
  const WalkShooter& shooter_;
  const std::vector<bool>& moved_;
};

}

#endif
