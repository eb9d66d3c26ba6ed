// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontSearch_h
#define irradiance_FrontSearch_h

#include "Kernels/FrontStages.h"
#include "Scene/RigidObject.h"
#include "Simd/Column.h"

namespace irradiance
{

/**
 * The closest hits of rays in the tree of one object, by stages, each a loop over all rays: prepare,
 * search (the first triangle that a search finds goes to a column, others, which are few, to a list),
 * confirm in double, first the column, then the list. Rays that the preparation leaves to others are
 * searched by the kernels of single rays.
 *
 * Owns the memory of the stages, which is used again from call to call.
 */
class FrontSearch final : private FrontTester
{
public:
  /// `rays`: in the space of the body, with the best hits so far, which are replaced by closer ones.
  /// `corners`: of the triangles of the body, to the bit.
  void run(const RigidObject& body, const TreeRays& rays, const CornerRows& corners);

private:
  class OtherRays;

  void search(const CornerRows& corners);
  void confirmFurther(std::uint32_t count);
  void test(std::uint32_t ray, std::uint32_t reference) override;
  Vector3 origin(std::uint32_t ray) const
  {
    return { rays_.origin[0][ray], rays_.origin[1][ray], rays_.origin[2][ray] };
  }
  Vector3 direction(std::uint32_t ray) const
  {
    return rays_.direction[0]
      ? Vector3(rays_.direction[0][ray], rays_.direction[1][ray], rays_.direction[2][ray])
      : Vector3(
          rays_.exactDirection[0][ray], rays_.exactDirection[1][ray], rays_.exactDirection[2][ray]);
  }

  const RigidObject* body_ = nullptr; ///< during a run
  TreeRays rays_;
  Column<PreparedQuery> queries_;
  Column<std::uint32_t> others_, candidate_;
  Column<FurtherCandidate> further_;
};

}

#endif
