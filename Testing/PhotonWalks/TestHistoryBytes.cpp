// SPDX-License-Identifier: BSD-3-Clause
// The bytes that the engine tells are the bytes that it allocates. Sanitizers have a heap of their
// own.

#include "Kit.h"

#include <malloc.h>

#if !IRRADIANCE_TEST_IS_SANITIZED && defined(__GLIBC__)

namespace irradiance::test
{
namespace
{

double heap()
{
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

struct Bytes
{
  double allocated, told;
};

Bytes bytesOf(const SceneObjects& objects, EngineSettings settings, std::uint32_t walks)
{
  settings.numberOfWalks = walks;
  const double before = heap();
  UpdatedEngine engine(objects, settings);
  return { heap() - before, static_cast<double>(engine.statistics().historyBytes) };
}

// Of more and fewer walks, so that the scene and what threads work with cancel out.
TEST(HistoryBytes, AreWhatIsAllocated)
{
  ObjectBuilder room, ball;
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 4 }), 12, grey(0.5), true);
  room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 3));
  ball.addSphere({ 2, 2, 1 }, 0.5, 8, grey(0.5));
  const SceneObjects objects{ room.build(), { ball.build() } };
  EngineSettings shot, gathered, barred, rays;
  gathered.gathersDirectLight = barred.gathersDirectLight = rays.gathersDirectLight = true;
  barred.replicates = 8;
  rays.cellEstimate = CellEstimate::Gathered;
  rays.gatherRays = 16;
  rays.gathersEverywhere = true;
  for (const EngineSettings& settings : { shot, gathered, barred, rays })
  {
    const Bytes few = bytesOf(objects, settings, 150000), many = bytesOf(objects, settings, 600000);
    EXPECT_NEAR((many.told - few.told) / (many.allocated - few.allocated), 1, 0.1);
    EXPECT_GT(many.told, 0.8 * many.allocated);
    EXPECT_LT(many.told, 1.05 * many.allocated);
  }
}

}
}

#endif
