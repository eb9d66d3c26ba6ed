// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LeafPhotons_h
#define irradiance_LeafPhotons_h

#include "Execution/Execution.h"
#include "History/WalkHistory.h"
#include "Light/SceneObjects.h"
#include "Photons/PhotonLeaf.h"

#include <memory>
#include <vector>

namespace irradiance
{

/**
 * All photons, bound to the leaf cells of the ray-casting trees (section 4.1 of the paper), each to
 * that of its object's own tree in model space. So a rigid motion changes nothing here but for the
 * walks that it changes, and only the leaves that they touch. A photon lies where its triangle and
 * its stored weights say.
 */
class LeafPhotons
{
public:
  /// Binds all photons of the history. If interrupted, or if update() is, this must be done anew.
  void build(const SceneObjects& objects, const WalkHistory& history, Execution& execution);
  /// `objects` and `history` are those after the change. The photons of objects with another body
  /// than before are bound anew, whatever `changes` says of them; all others must be told. An object
  /// may not be added or dropped. Throws std::logic_error if a photon that is gone never was here.
  void update(const SceneObjects& objects, const WalkHistory& history, const PhotonChanges& changes,
    Execution& execution);

  std::uint32_t numberOfObjects() const { return static_cast<std::uint32_t>(trees_.size()); }
  const TriangleTree& tree(std::uint32_t object) const { return trees_[object].body->tree(); }
  /// `leaf`: the number of its first block.
  const PhotonLeaf& leaf(std::uint32_t object, std::uint32_t leaf) const
  {
    return trees_[object].leaves[leaf];
  }
  bool isEmpty(std::uint32_t object) const;
  std::size_t bytes() const;

private:
  struct Tree
  {
    std::shared_ptr<const RigidObject> body;
    LeafTable table;
    std::vector<PhotonLeaf> leaves; ///< one for each block, of which some are not the first
  };
  class Binding;

  std::vector<Tree> trees_;
};

/// A photon's place in model space.
inline Vector3 modelPoint(const TriangleMesh& mesh, const Photon& photon)
{
  Hit hit;
  hit.weights = photon.weights;
  const Vector3 weights = weightsOf(hit);
  const Triangle& triangle = mesh[photon.id.triangle];
  return weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
}

}

#endif
