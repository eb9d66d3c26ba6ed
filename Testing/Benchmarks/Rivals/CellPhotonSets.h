// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "Rivals/PhotonSet.h"
#include "Surfaces/SceneCells.h"

#include <array>
#include <memory>
#include <vector>

namespace irradiance
{

/**
 * The photons that arrived on each specular cell. Its radiance depends on where each of them came
 * from, so a sum of their power does not suffice (section 4.2 of the paper). Other cells have no
 * set, and objects without a specular cell cost nothing.
 *
 * What changes the sets works in parallel, each thread on sets of its own. It throws Interrupted;
 * then some of the photons are missing.
 */
class CellPhotonSets
{
public:
  CellPhotonSets() = default;
  /// The specular cells of these objects, without photons.
  explicit CellPhotonSets(const SceneObjects& objects);

  /// Adds the photons of blocks [`first`, `end`) of the history.
  void add(const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution);
  void apply(const PhotonChanges& changes, Execution& execution);

  /// Whether there is no specular cell.
  bool isEmpty() const { return sets_.empty(); }
  /// The number of photons on a cell; 0 if it is not specular.
  std::size_t size(const SceneCell& cell) const;
  /// The photons on a cell, in order, so that a sum over them does not depend on how they came.
  std::vector<SegmentRef> sorted(const SceneCell& cell) const;
  /// Memory held.
  std::size_t bytes() const;

private:
  /// Sets are changed by the threads in parts of consecutive ones.
  static constexpr std::size_t kParts = 64;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Of an object.
  struct Cells
  {
    std::shared_ptr<const Material> material; ///< null if no cell is specular
    std::size_t firstSet = 0;
    std::vector<std::uint32_t> sets; ///< of each cell, from the first set; or kNone
  };
  /// A photon to be inserted or removed.
  struct Change
  {
    PhotonSet* set;
    SegmentRef photon;
  };
  using Parts = std::array<std::vector<Change>, kParts>;

  /// Null if the cell is not specular.
  const PhotonSet* setOf(const SceneCell& cell) const;
  class Collector;
  std::vector<Parts> collect(const std::vector<Photon>& photons);
  std::vector<Parts> collect(
    const WalkHistory& history, std::size_t first, std::size_t end, Execution& execution);
  void insert(const std::vector<Parts>& changes, Execution& execution);
  void remove(const std::vector<Parts>& changes, Execution& execution);
  void reserve(const std::vector<Parts>& changes, std::size_t part);
  template <class Work>
  static void forEach(const std::vector<Parts>& changes, std::size_t part, const Work& work);

  std::vector<Cells> objects_;
  std::vector<PhotonSet> sets_;
  unsigned partShift_ = 0; ///< set i belongs to part i >> partShift_
};

}
