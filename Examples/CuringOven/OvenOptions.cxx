// SPDX-License-Identifier: BSD-3-Clause
#include "OvenOptions.h"

#include "CommandLine.h"
#include "Oven.h"

#include <stdexcept>

namespace curingoven
{
namespace
{

using namespace movingteapot;

Setter Add(std::vector<std::string>& values)
{
  return [&values](const std::string& text) { values.push_back(text); };
}

Setter Positive(double& value, const char* unit)
{
  return Number(value, 1e-9, 1e9, std::string("a number above 0, in ") + unit + ",");
}

std::vector<Option> OptionsOf(OvenOptions& o)
{
  return {
    { "--part", "FILE", "", "a part of yours, or NAME=FILE; once for each part (*)", Add(o.Parts) },
    { "--unit", "M", "0", "a unit of the parts' files in m, 0.001 for mm; 0: scaled to --part-size",
      Number(o.Unit, 0, 1e6, "a length in m, or 0,") },
    { "--part-size", "M", "0.15", "longest edge of a part's box in m", Positive(o.PartSize, "m") },
    { "--cells", "N", "10000", "into so many cells each part is cut at least", Count(o.Cells, 1) },
    { "--lamps", "N", "4", "strip lamps across the conveyor", Count(o.Lamps, 0) },
    { "--lamp-power", "W", "600", "UV from each lamp", Positive(o.LampPower, "W") },
    { "--speed", "M/S", "0.2", "of the conveyor", Positive(o.Speed, "m/s") },
    { "--least-dose", "J/M2", "2000", "below it a cell is under-cured",
      Number(o.LeastDose, 0, 1e12, "a dose in J/m2") },
    { "--most-dose", "J/M2", "10000", "above it a cell is over-cured",
      Positive(o.MostDose, "J/m2") },
    { "--walks", "N", "1000000", "photon walks", Count(o.Walks, 1) },
    { "--spread", "N", "0",
      "at each step a small cell draws on N photons of its neighbourhood, such as 12: less noise, "
      "some "
      "blur, more time; 0: on its own",
      Count(o.Spread, 0) },
    { "--accuracy", "R", "0",
      "more walks until 95 % of the parts' area is known within +-R of its dose, or of the least "
      "dose "
      "if that is more; 0: no",
      Number(o.Accuracy, 0, 10, "a number from 0 to 10") },
    { "--most-walks", "N", "16000000", "where --accuracy gives up", Count(o.MostWalks, 1) },
    { "--steps", "N", "200", "times at which the light is computed", Count(o.Steps, 2) },
    { "--compare", "N", "0", "of these, so many are compared with a fresh start, bit for bit",
      Count(o.Compare, 0) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--size", "WxH", "1280x640", "size of the pictures in pixels", Size(o.Width, o.Height) },
    { "--no-pictures", "", "", "no pictures and no movie", Switch(o.Pictures, false) },
    { "--output", "FOLDER", "./CuringOven-output", "where everything is written", Text(o.Output) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

void Require(bool isGood, const std::string& what)
{
  if (!isGood)
  {
    throw std::runtime_error(what);
  }
}

}

OvenOptions ReadOptions(const std::vector<std::string>& words)
{
  OvenOptions o;
  ReadCommandLine(OptionsOf(o), words);
  Require(o.Lamps >= 1, "--lamps: an oven without lamps cures nothing; at least 1 is expected");
  Require(o.Lamps <= MostLamps,
    "--lamps: " + std::to_string(o.Lamps) + " do not fit into the tunnel; at most " +
      std::to_string(MostLamps) + " are expected");
  Require(o.LeastDose < o.MostDose,
    "--least-dose and --most-dose are the wrong way round: the least has to be below the most");
  Require(o.Spread <= 1000000, "--spread: at most 1000000 photons are expected");
  Require(o.Compare <= o.Steps, "--compare: there are not so many steps");
  Require(o.Walks <= o.MostWalks || o.Accuracy == 0, "--most-walks is below --walks");
  return o;
}

std::string HelpText()
{
  OvenOptions ignored;
  return "CuringOven: the UV dose of machine parts that ride through an oven.\n\nOptions:\n" +
    ListOptions(OptionsOf(ignored)) +
    "\n(*) .stl .obj .ply .off .vtp or .vtk, z up. The name is that of the file without ending.\n";
}

}
