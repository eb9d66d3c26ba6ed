// SPDX-License-Identifier: BSD-3-Clause
#include "OvenOptions.h"

#include "CommandLine.h"
#include "Oven.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

// Length, width and height.
Setter Box(double& length, double& width, double& height)
{
  return [&](const std::string& text) {
    int end = 0;
    const int read = std::sscanf(text.c_str(), "%lfx%lfx%lf%n", &length, &width, &height, &end);
    if (read != 3 || end != int(text.size()) || !(std::min({ length, width, height }) >= 0.3) ||
      !(std::max({ length, width, height }) <= 100))
    {
      throw std::invalid_argument("three lengths from 0.3 to 100 m, such as 3x0.8x0.5,");
    }
  };
}

Setter Add(std::vector<double>& values)
{
  return [&values](const std::string& text) {
    double value;
    Number(value, -100, 100, "a place from -100 to 100 m")(text);
    values.push_back(value);
  };
}

/** Lamps at equal distances, in place of single ones. */
struct LampRow
{
  int Lamps;
  double Pitch; // m
};

std::vector<Option> OptionsOf(OvenOptions& o, LampRow& row)
{
  return {
    { "--part", "FILE", "", "a part of yours, or NAME=FILE; once for each part (*)", Add(o.Parts) },
    { "--unit", "M", "0", "unit of the parts' files in m, 0.001 for mm; 0: scaled to --part-size",
      Number(o.Unit, 0, 1e6, "a length in m, or 0,") },
    { "--part-size", "M", "0.15", "longest edge of a part's box, m", Positive(o.PartSize, "m") },
    { "--cells", "N", "10000", "into so many cells each part is cut at least", Count(o.Cells, 1) },
    { "--oven", "LxWxH", "3x0.8x0.5", "tunnel along, across and above the conveyor, m",
      Box(o.OvenLength, o.OvenWidth, o.OvenHeight) },
    { "--opening", "M", "0.28", "height of the openings at its ends, m", Positive(o.Opening, "m") },
    { "--lamps", "N", "4", "strip lamps across the conveyor", Count(row.Lamps, 0) },
    { "--lamp-pitch", "M", "0.3", "from one of them to the next, m", Positive(row.Pitch, "m") },
    { "--lamp-at", "M", "",
      "in their place, a lamp so far from the middle of the tunnel, m; once for each",
      Add(o.LampPlaces) },
    { "--lamp-height", "M", "0.46", "lamps above the belt, m", Positive(o.LampHeight, "m") },
    { "--lamp-power", "W", "600", "UV from each lamp, W", Positive(o.LampPower, "W") },
    { "--speed", "M/S", "0.2", "speed of the conveyor, m/s", Positive(o.Speed, "m/s") },
    { "--least-dose", "J/M2", "2000", "below it a cell is under-cured, J/m2",
      Number(o.LeastDose, 0, 1e12, "a dose in J/m2") },
    { "--most-dose", "J/M2", "10000", "above it a cell is over-cured, J/m2",
      Positive(o.MostDose, "J/m2") },
    { "--walks", "N", "1000000", "photon walks", Count(o.Walks, 1) },
    { "--spread", "N", "0",
      "photons around it on which a small cell draws at each step, such as 12; 0: its own",
      Count(o.Spread, 0) },
    { "--spread-dose", "N", "0",
      "photons around it, of all steps, on which the dose of a small cell draws; 0: its own",
      Count(o.SpreadDose, 0) },
    { "--accuracy", "R", "0",
      "more walks until 95 % of the area is known within +-R of its dose (**); 0: no",
      Number(o.Accuracy, 0, 10, "a number from 0 to 10") },
    { "--most-walks", "N", "16000000", "where --accuracy gives up", Count(o.MostWalks, 1) },
    { "--steps", "N", "200", "times at which the light is computed", Count(o.Steps, 2) },
    { "--compare", "N", "0", "of these, so many are compared with a fresh start, bit for bit",
      Count(o.Compare, 0) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--size", "WxH", "1280x416", "size of the film in pixels", Size(o.Width, o.Height) },
    { "--no-pictures", "", "", "no pictures and no movie", Switch(o.Pictures, false) },
    { "--output", "FOLDER", "./CuringOven-output", "where all results go", Text(o.Output) },
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

// They fit between the ends of the tunnel, side by side, below its ceiling and above what rides.
void CheckLamps(const OvenOptions& o, const std::string& they)
{
  std::vector<double> places = o.LampPlaces;
  std::sort(places.begin(), places.end());
  const double half = ReflectorHalfWidth;
  Require(o.OvenLength / 2 - half >= std::max(-places.front(), places.back()),
    they + " not fit into the tunnel; --oven gives its length");
  for (std::size_t i = 1; i < places.size(); ++i)
  {
    Require(places[i] - places[i - 1] >= 2 * half,
      they + " not fit side by side; a lamp with its reflector takes " + std::to_string(2 * half) +
        " m");
  }
  Require(o.Opening < o.OvenHeight, "--opening is higher than the tunnel of --oven");
  Require(o.LampHeight + FocalLength < o.OvenHeight,
    "--lamp-height: lamps with their reflectors do not fit below the ceiling of --oven");
  Require(o.LampHeight - LampRadius > o.Opening,
    "--lamp-height: lamps hang where parts ride, which may be as high as --opening");
}

}

OvenOptions ReadOptions(const std::vector<std::string>& words)
{
  OvenOptions o;
  LampRow row;
  ReadCommandLine(OptionsOf(o, row), words);
  Require(row.Lamps >= 1, "--lamps: an oven without lamps cures nothing; at least 1 is expected");
  const bool isRow = o.LampPlaces.empty();
  for (int i = 0; isRow && i < row.Lamps; ++i)
  {
    o.LampPlaces.push_back(row.Pitch * (i - (row.Lamps - 1) / 2.0));
  }
  CheckLamps(o, isRow ? "--lamps: " + std::to_string(row.Lamps) + " do" : "--lamp-at: they do");
  Require(o.LeastDose < o.MostDose,
    "--least-dose and --most-dose are the wrong way round: the least has to be below the most");
  Require(o.Spread <= 1000000, "--spread: at most 1000000 photons are expected");
  Require(o.SpreadDose <= 1000000, "--spread-dose: at most 1000000 photons are expected");
  Require(o.Compare <= o.Steps, "--compare: there are not so many steps");
  Require(o.Walks <= o.MostWalks || o.Accuracy == 0, "--most-walks is below --walks");
  return o;
}

std::string HelpText()
{
  OvenOptions ignored;
  LampRow row;
  return ComposeHelp("CuringOven: the UV dose of machine parts that ride through an oven.",
    OptionsOf(ignored, row),
    "(*) .stl .obj .ply .off .vtp or .vtk, z up. The name is the file's without ending.\n"
    "    Without any: five machine parts that Data/fetch.sh gets.\n"
    "(**) or of the least dose, if that is more.\n",
    "Parts.csv, Cells.csv, Steps.csv, CuringOven.vtm, ParaViewState.py, CuringOven.ogv, "
    "CuringOven.png, Parts.png");
}

}
