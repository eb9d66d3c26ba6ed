// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "CommandLine.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace movingteapot
{
namespace
{

Setter TraversalMode(int& mode)
{
  return [&mode](const std::string& text) {
    const std::vector<std::string> names = { "onetree", "sequential", "parallel" };
    mode = int(std::find(names.begin(), names.end(), text) - names.begin());
    if (mode == int(names.size()))
    {
      throw std::invalid_argument("onetree, sequential or parallel");
    }
  };
}

std::vector<Option> OptionsOf(Options& o)
{
  return {
    { "--walks", "N", "1000000", "photon walks", Count(o.Walks, 1) },
    { "--frames", "N", "60", "frames, the first one included", Count(o.Frames, 2) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--output", "FOLDER", "./MovingTeapot-output", "where all results go", Text(o.Output) },
    { "--size", "WxH", "1280x720", "size of the pictures in pixels", Size(o.Width, o.Height) },
    { "--gather", "N", "0", "rays by which cells gather light; 0: photons alone",
      Count(o.GatherRays, 0) },
    { "--smooth", "N", "2", "times to smooth head and teapot in such pictures",
      Count(o.Smoothings, 0) },
    { "--traversal", "MODE", "parallel", "onetree, sequential or parallel",
      TraversalMode(o.TraversalMode) },
    { "--cell-size", "M", "0.046", "edge of the cells of the walls, m",
      Number(o.Scene.CellSize, 0.005, 1.0, "a number from 0.005 to 1") },
    { "--teapot-segments", "N", "10", "cuts along each edge of a teapot patch",
      Count(o.Scene.TeapotSegments, 2) },
    { "--head", "FILE", "", "a mesh of yours for the head (*)", Text(o.Scene.HeadFile) },
    { "--teapot", "FILE", "", "a mesh of yours for the teapot (*)", Text(o.Scene.TeapotFile) },
    { "--no-pictures", "", "", "no PNG files and no movie", Switch(o.Pictures, false) },
    { "--no-comparison", "", "", "the updates alone: half the time and memory",
      Switch(o.Comparison, false) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

}

Options ReadOptions(const std::vector<std::string>& words)
{
  Options result;
  ReadCommandLine(OptionsOf(result), words);
  return result;
}

std::string HelpText()
{
  Options ignored;
  return ComposeHelp("MovingTeapot: the light in a room through which a teapot moves.",
    OptionsOf(ignored), "(*) .obj .ply .stl .vtp .vtk or .off, z up; it is scaled to fit.\n",
    "MovingTeapot.pvd, ParaViewState.py, MovingTeapot.ogv, pictures/");
}

}
