// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "History/WalkHistory.h"
#include "Photons/PhotonTree.h"
#include "Surfaces/SceneObjects.h"

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * The photons, bound to the leaf cells of the ray-casting trees (section 4.1 of the paper), each to
 * a leaf of its object's own tree in model space. So a rigid motion changes nothing here except the
 * photons of walks that it changes, and only the leaves that they touch. A photon lies where its
 * triangle and its stored weights say.
 *
 * What changes the leaves works in parallel, each thread on leaves of its own. It throws
 * Interrupted; then some of the photons are missing.
 */
class LeafPhotons
{
public:
  LeafPhotons() = default;
  /// The leaves of these objects, without photons.
  explicit LeafPhotons(const SceneObjects& objects);

  /// Adds the photons of blocks [`first`, `end`) of the history.
  void add(const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution);
  /// `objects` and `histories` are those after the changes. An object with another body than before
  /// has a new tree, to which its photons are bound again; it does not matter what `changes` says
  /// of them.
  void apply(const SceneObjects& objects, const WalkHistories& histories,
    const PhotonChanges& changes, Execution& execution);

  const TriangleTree& tree(std::uint32_t object) const { return trees_[object].body->tree(); }
  /// `leaf`: the number of its first block.
  const PhotonTree& leaf(std::uint32_t object, std::uint32_t leaf) const
  {
    return trees_[object].leaves[leaf];
  }
  /// Photons on all objects.
  std::size_t size() const;
  /// Whether no photon is on the object.
  bool isEmpty(std::uint32_t object) const { return trees_[object].size() == 0; }
  /// Memory held.
  std::size_t bytes() const;

private:
  struct Tree
  {
    Tree() = default;
    explicit Tree(std::shared_ptr<const RigidObject> itsBody)
      : body(std::move(itsBody))
      , table(body->tree())
      , leaves(body->tree().numberOfBlocks())
    {
    }
    /// Photons.
    std::size_t size() const
    {
      return std::accumulate(leaves.begin(), leaves.end(), std::size_t{},
        [](std::size_t sum, const PhotonTree& leaf) { return sum + leaf.size(); });
    }

    std::shared_ptr<const RigidObject> body;
    LeafTable table;
    std::vector<PhotonTree>
      leaves; ///< one for each block; only the first block of a leaf uses its own
  };
  class Binding;

  std::vector<Tree> trees_; ///< of objects
};

/// A point of a triangle in model space, given by the weights of a photon or a hit.
inline Vector3 modelPoint(
  const TriangleMesh& mesh, std::uint32_t triangle, const std::array<float, 2>& weights)
{
  Hit hit;
  hit.weights = weights;
  const Vector3 w = weightsOf(hit);
  return w[0] * mesh[triangle].a + w[1] * mesh[triangle].b + w[2] * mesh[triangle].c;
}

}
