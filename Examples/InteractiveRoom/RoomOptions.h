// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace interactiveroom
{

/** What the user may choose on the command line. The defaults stand in RoomOptions.cxx. */
struct RoomOptions
{
  std::string Preset;                     // see RoomPresets.h
  std::vector<std::string> Still, Moving; // files; if there is any, in place of the preset
  double Unit;                            // m, of these files
  int Walks;
  int GatherRays;     // of each small cell; 0: these are spread
  int Threads;        // 0: all the machine has
  double Brightest;   // W/m2, end of the colours; 0: as the light is
  int Width, Height;  // pixels
  std::string Events; // a file to play
  std::string Record; // a file to write
  bool Movie = false; // of what is played
  int Frames;         // of the measurement; 0: none
  bool Help = false;
  std::string Output; // a folder
};

/** Throws std::runtime_error that names the option and what is wrong with it. */
RoomOptions ReadOptions(const std::vector<std::string>& words);

std::string HelpText();

}
