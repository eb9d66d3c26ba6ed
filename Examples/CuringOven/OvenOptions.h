// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace curingoven
{

/** What the user may choose on the command line. The defaults stand in OvenOptions.cxx. */
struct OvenOptions
{
  std::vector<std::string> Parts; // FILE or NAME=FILE; none: those that Data/fetch.sh gets
  double Unit;                    // m, of the parts' files; 0: parts are scaled to PartSize
  double PartSize;                // m, the longest edge of a part's box
  int Cells;                      // into how many a part is cut at least
  double OvenLength, OvenWidth, OvenHeight; // m: along the conveyor, across it, above it
  double Opening;                           // m, height of the openings at its ends
  std::vector<double> LampPlaces;           // m, along the conveyor from the middle of the tunnel
  double LampHeight;                        // m, of the lamps' axes above the belt
  double LampPower;                         // W of UV from each lamp
  double Speed;                             // of the conveyor, m/s
  double LeastDose, MostDose;               // J/m2
  int Walks, MostWalks;                     // photon walks
  int Spread;           // photons at each step on which a small cell draws; 0: on its own alone
  int SpreadDose;       // photons of all steps on which the dose of a small cell draws; 0: its own
  double Accuracy;      // see OvenOptions.cxx; 0: none asked for
  int Steps;            // times at which the light is computed
  int Compare;          // of these, how many are compared with a fresh start
  int Threads;          // 0: all the machine has
  int Width, Height;    // pixels
  bool Pictures = true; // false also where no window can be opened
  bool Help = false;
  std::string Output; // a folder
};

/** Throws std::runtime_error that names the option and what is wrong with it. */
OvenOptions ReadOptions(const std::vector<std::string>& words);

std::string HelpText();

}
