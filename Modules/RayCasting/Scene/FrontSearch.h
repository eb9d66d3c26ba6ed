// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontSearch_h
#define irradiance_FrontSearch_h

#include "Meshes/TriangleMesh.h"
#include "Scene/FrontDescent.h"

namespace irradiance
{

/**
 * The closest hits of rays in a tree of one object: what FrontDescent finds is confirmed in double,
 * first the column, then the list.
 *
 * Owns its memory, which is used again from call to call.
 */
class FrontSearch final : private FrontTester
{
public:
  /// `rays`: in the space of the body, with the best hits so far, which are replaced by closer
  /// ones. `corners`: of the triangles of the mesh, to the bit.
  void run(const TriangleTree& tree, const TriangleMesh& mesh, const TreeRays& rays,
    const CornerRows& corners);

private:
  void confirmFurther();
  void test(std::uint32_t ray, std::uint32_t reference) override;

  const TriangleMesh* mesh_ = nullptr; ///< during a run
  TreeRays rays_;
  FrontDescent descent_;
};

}

#endif
