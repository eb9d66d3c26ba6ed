// SPDX-License-Identifier: BSD-3-Clause
#ifndef PathTracedRoomOptions_h
#define PathTracedRoomOptions_h

#include "Scene/Scene.h"

#include <string>
#include <vector>

namespace pathtracedroom
{

/** What the user may choose on the command line. */
struct Options
{
  std::string Scene = "room";
  int Segments = 30; // cuts along each edge of a teapot patch
  int Width = 640, Height = 480;
  int Samples = 64; // a pixel
  int Threads = 0;  // 0: all the machine has
  std::string Output = "PathTracedRoom";
  irradiance::TraversalMode Traversal = irradiance::TraversalMode::Parallel;
  bool CompareTraversals = false;
  int Rounds = 5;   // of the comparison
  std::string Help; // not empty if it was asked for

  struct TraversalName
  {
    const char* Name;
    irradiance::TraversalMode Mode;
  };
  static const std::vector<TraversalName> Traversals;
};

/** Throws std::runtime_error that says what is wrong. */
Options ReadOptions(int argc, const char* const* argv);

}

#endif
