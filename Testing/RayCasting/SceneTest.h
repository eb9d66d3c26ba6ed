// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestRays.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance::test
{

/// Rays aimed at the triangles of all objects, in world space.
inline RaySource raysAt(const NamedScene& named, unsigned seed)
{
  std::vector<Triangle> triangles;
  std::vector<TriangleId> ids;
  const Scene scene = named.scene(TraversalMode::Parallel);
  const SurfaceRecords records = named.records();
  for (std::uint32_t i = 0; i < records.size(); ++i)
  {
    ids.push_back(records.numbers().idOf(i));
    triangles.push_back(scene.worldTriangle(ids.back()));
  }
  return RaySource(triangles, seed, ids);
}

/// A test of one scene.
class SceneTest : public testing::TestWithParam<SceneMaker>
{
protected:
  const NamedScene named_ = GetParam().make();
};

}
