// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/Scene.h"

#include <string>
#include <vector>

namespace pathtracedroom
{

/** What the user may choose on the command line. The defaults stand in Options.cxx. */
struct Options
{
  std::string Scene;
  int Segments;       // cuts along each edge of a teapot patch
  int Width, Height;  // pixels
  int Samples;        // a pixel
  int Threads;        // 0: all the machine has
  std::string Output; // a folder
  irradiance::TraversalMode Traversal;
  bool CompareTraversals = false;
  int Rounds; // of the comparison
  bool Help = false;

  struct TraversalName
  {
    const char* Name;
    irradiance::TraversalMode Mode;
  };
  static const std::vector<TraversalName> Traversals;
};

/** Throws std::runtime_error that says what is wrong. */
Options ReadOptions(const std::vector<std::string>& words);

std::string HelpText();

}
