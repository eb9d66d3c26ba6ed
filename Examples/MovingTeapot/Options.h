// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TeapotScene.h"

#include <string>
#include <vector>

namespace movingteapot
{

/** What the user may choose on the command line. The defaults stand in Options.cxx. */
struct Options
{
  int Walks;
  int Frames;
  int Threads; // 0: all the machine has
  std::string Output;
  int Width, Height;    // pixels
  int GatherRays;       // of vtkIrradianceFilter, for all cells; 0: walks are shot, as in the paper
  int Smoothings;       // of head and teapot in pictures of what was shot
  int TraversalMode;    // of vtkIrradianceFilter: one tree, sequential, parallel
  SceneConfig Scene;    // without a HeadFile it is the one that Data/fetch.sh gets, if it is there
  bool Pictures = true; // false also where no window can be opened
  bool Comparison = true;
  bool Help = false;
};

/**
 * From the words "--option value" or "--option=value". Throws std::runtime_error that names the
 * option and what is wrong with it.
 */
Options ReadOptions(const std::vector<std::string>& words);

std::string HelpText();

}
