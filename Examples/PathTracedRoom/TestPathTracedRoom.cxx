// SPDX-License-Identifier: BSD-3-Clause
// The tracer against what is known beforehand, against itself, and against the filter.
#include "BidirectionalTracer.h"
#include "CameraRays.h"

#include "../../Testing/PhotonWalks/LambertContour.h"
#include "../../Testing/PhotonWalks/TestScenes.h"
#include "../../Testing/PhotonWalks/ThreadExecution.h"

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

using namespace irradiance;
using namespace pathtracedroom;

namespace
{

SceneObjects furnace()
{
  test::ObjectBuilder room, ball;
  const double reflectances[6] = { 0.1, 0.8, 0.3, 0.6, 0.5, 0.2 };
  for (int side = 0; side < 6; ++side)
  {
    room.addSide(test::box({ 0, 0, 0 }, { 2, 2, 2 }), side, 2,
      test::grey(reflectances[side], 1 - reflectances[side]), true);
  }
  ball.addSphere({ 0, 0, 0 }, 0.5, 4, test::grey(0.7, 0.3));
  return { room.build(), { ball.build(test::shift({ 1, 1, 1 })) } };
}

}

TEST(Furnace, Cells)
{
  const SceneObjects objects = furnace();
  std::vector<CellId> cells;
  for (std::size_t i = 0; i < 24; ++i) cells.push_back({ 0, i });
  for (std::size_t i = 0; i < 24; ++i) cells.push_back({ 1, i });
  Execution serial;
  auto start = std::chrono::steady_clock::now();
  const Estimates e = irradianceAt(objects, cells, {}, 16, 256, serial);
  std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s for " << 16*256*48 << " pairs\n";
  for (std::size_t i = 0; i < cells.size(); ++i)
    std::cout << e.mean(i)[0] << " +- " << e.standardError(i)[0] << " t " << (e.mean(i)[0]-1)/e.standardError(i)[0] << "\n";
}

TEST(Furnace, Pixels)
{
  const SceneObjects objects = furnace();
  const CameraRays camera({ { 0.2, 0.3, 0.4 }, { 1, 1, 1 }, { 0, 0, 1 }, 1.0, 6, 4 });
  const BidirectionalTracer tracer(objects, camera, {});
  Execution serial;
  Estimates e(camera.numberOfBins());
  for (int pass = 0; pass < 16; ++pass) e.add(tracer.trace(pass, 256, serial));
  for (std::size_t i = 0; i < camera.numberOfBins(); ++i)
    std::cout << e.mean(i)[0]*M_PI << " +- " << e.standardError(i)[0]*M_PI << " t " << (e.mean(i)[0]-1/M_PI)/e.standardError(i)[0] << "\n";
}
