// SPDX-License-Identifier: BSD-3-Clause
#include "RoomOptions.h"

#include "CommandLine.h"
#include "RoomPresets.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <stdexcept>

namespace interactiveroom
{
namespace
{

using namespace movingteapot;

Setter Preset(std::string& value)
{
  return [&value](const std::string& text) {
    const std::vector<std::string>& names = PresetNames();
    if (std::find(names.begin(), names.end(), text) == names.end())
    {
      throw std::invalid_argument("room, oven or aisle");
    }
    value = text;
  };
}

Setter Add(std::vector<std::string>& values)
{
  return [&values](const std::string& text) { values.push_back(text); };
}

std::vector<Option> OptionsOf(RoomOptions& o)
{
  return {
    { "--preset", "NAME", "room", "room, oven or aisle", Preset(o.Preset) },
    { "--static", "FILE", "", "in its place, a mesh of yours that stays; once for each (*)",
      Add(o.Still) },
    { "--dynamic", "FILE", "", "in its place, a mesh of yours to move; once for each (*)",
      Add(o.Moving) },
    { "--unit", "M", "1", "unit of these files in m, 0.001 for mm",
      Number(o.Unit, 1e-9, 1e9, "a length above 0, in m,") },
    { "--walks", "N", "250000", "photon walks", Count(o.Walks, 16) },
    { "--gather-rays", "N", "8",
      "rays from each small cell, 16: smoother, 4: faster; 0: spread over neighbours instead",
      Count(o.GatherRays, 0) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--brightest", "W/M2", "0", "end of the colours, W/m2; 0: 95 % of the area receive less",
      Number(o.Brightest, 0, 1e12, "a number from 0 to 1e12") },
    { "--size", "WxH", "1024x576", "size of the window in pixels", Size(o.Width, o.Height, 320) },
    { "--events", "FILE", "", "plays what --record wrote, and leaves a picture of the end",
      Text(o.Events) },
    { "--movie", "", "", "with --events, a movie too", Switch(o.Movie, true) },
    { "--record", "FILE", "", "writes what mouse and keys do to FILE", Text(o.Record) },
    { "--frames", "N", "0", "drags a thing for N frames and tells how long they take; 0: no",
      Count(o.Frames, 0) },
    { "--output", "FOLDER", "./InteractiveRoom-output", "where picture and movie go",
      Text(o.Output) },
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

RoomOptions ReadOptions(const std::vector<std::string>& words)
{
  RoomOptions o;
  ReadCommandLine(OptionsOf(o), words);
  Require(!o.Moving.empty() || o.Still.empty(), "--dynamic: there is nothing to move");
  Require(o.Events.empty() || vtksys::SystemTools::FileExists(o.Events, true),
    "--events: " + o.Events + ": there is no such file");
  Require(o.Events.empty() || (o.Record.empty() && o.Frames == 0),
    "--events excludes --record and --frames");
  Require(!o.Movie || !o.Events.empty(), "--movie: it shows what --events plays; no file is given");
  Require(o.Record.empty() || o.Frames == 0, "--record and --frames exclude each other");
  return o;
}

std::string HelpText()
{
  RoomOptions ignored;
  return ComposeHelp("InteractiveRoom: a lit room in which you move things, and the light follows.",
    OptionsOf(ignored),
    "(*) .obj .ply .stl .vtp .vtk or .off, z up, each where its file has it. If none has a cell "
    "array\n"
    "    RadiantExitance (W/m2), a lamp hangs above them.\n",
    "with --events, InteractiveRoom.png and InteractiveRoom.ogv");
}

}
