// SPDX-License-Identifier: BSD-3-Clause
#ifndef Options_h
#define Options_h

#include <string>

namespace movingteapot
{

/** What the user may choose on the command line. The defaults stand in Options.cxx. */
struct Options
{
  int Walks;
  int Frames;
  int Threads; // 0: all the machine has
  std::string Output;
  int Width, Height;      // pixels
  int Smoothings;         // of head and teapot in the pictures
  int TraversalMode;      // of vtkIrradianceFilter: one tree, sequential, parallel
  double CellSize;        // m
  int TeapotSegments;     // cuts along each edge of a patch
  std::string HeadFile;   // empty: the one that Data/fetch.sh gets, if it is there
  std::string TeapotFile; // empty: the Utah teapot
  bool Pictures = true;
  bool Comparison = true;
  bool Help = false;
};

/** Throws std::runtime_error that names the option and what is wrong with it. */
Options ReadOptions(int argc, char* argv[]);

std::string HelpText();

}

#endif
