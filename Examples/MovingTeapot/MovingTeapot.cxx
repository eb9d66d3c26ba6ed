// SPDX-License-Identifier: BSD-3-Clause
/**
 * The experiment of L. Szecsi, B. Benedek, L. Szirmay-Kalos, "Accelerating Animation Through
 * Verification of Shooting Walks", section 5, at today's scale: a box with a stationary head and a
 * moving teapot, lit by a lamp, the walls cut into small cells. Every frame brings the irradiance
 * of every cell up to date; at the end stands the paper's table, with its figures beside ours. See
 * README.md in this folder.
 */
#include "FrameFile.h"
#include "Options.h"
#include "Performance.h"
#include "ProgressBar.h"
#include "Recording.h"
#include "SameBits.h"
#include "TimingTable.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace movingteapot;

namespace
{

// The head that was asked for; else the fetched one; else none.
std::string FindHead(const std::string& asked)
{
  if (!asked.empty())
  {
    return asked;
  }
  for (const char* place : { MOVINGTEAPOT_HEAD, "Data/downloaded/mannequin-devil.off" })
  {
    if (vtksys::SystemTools::FileExists(place, true))
    {
      return place;
    }
  }
  std::cerr << "The plinth stays empty: Data/fetch.sh gets the head, or --head takes another.\n";
  return "";
}

TeapotScene MakeScene(const Options& options)
{
  SceneConfig config;
  config.CellSize = options.CellSize;
  config.TeapotSegments = options.TeapotSegments;
  config.HeadFile = FindHead(options.HeadFile);
  config.TeapotFile = options.TeapotFile;
  return MakeTeapotScene(config);
}

void PrintScene(const TeapotScene& scene, const Options& options)
{
  std::cout << "Room " << scene.Room->GetNumberOfCells() << ", lamp "
            << scene.Lamp->GetNumberOfCells() << ", plinth " << scene.Plinth->GetNumberOfCells()
            << ", head " << (scene.Head ? scene.Head->GetNumberOfCells() : 0) << ", teapot "
            << scene.Teapot->GetNumberOfCells() << " cells; " << options.Walks << " walks, "
            << options.Frames << " frames, " << vtkSMPTools::GetEstimatedNumberOfThreads()
            << " threads." << std::endl;
}

std::string CaptionOf(int frame, int frames, const FrameReport& report)
{
  char text[120];
  if (frame == 0)
  {
    std::snprintf(text, sizeof text, "Frame 1 of %d: all walks shot", frames);
  }
  else
  {
    std::snprintf(text, sizeof text, "Frame %d of %d: %.1f %% of the path segments shot again",
      frame + 1, frames, 100.0 * report.RepairedSegments / report.Segments);
  }
  return text;
}

// What is compared at the end; Uncached and Afresh are null without a comparison.
struct Performances
{
  std::unique_ptr<Performance> Cached, Uncached, Afresh;
};

Performances Play(const TeapotScene& scene, const Options& options, Recording& recording)
{
  const int frames = options.Frames;
  const double work = Performance::ShootingWork + Performance::UpdateWork * (frames - 1);
  ProgressBar bar(options.Comparison ? 2 * work + Performance::ShootingWork : work);
  const auto make = [&](const char* name, bool cacheStaticHits) {
    const AnimationConfig config = { options.Walks, options.TraversalMode, cacheStaticHits };
    return std::make_unique<Performance>(name, scene, config, frames, bar);
  };

  Performances play;
  play.Cached = make("", true);
  std::vector<Performance*> inTurn = { play.Cached.get() };
  if (options.Comparison)
  {
    play.Uncached = make(", without cache", false);
    inTurn.push_back(play.Uncached.get());
  }
  for (int frame = 0; frame < frames; ++frame)
  {
    for (Performance* performance : inTurn)
    {
      performance->Show(frame);
    }
    std::reverse(inTurn.begin(), inTurn.end()); // neither is always the first
    recording.Add(frame, play.Cached->TimeOf(frame), play.Cached->GetScene(),
      CaptionOf(frame, frames, play.Cached->GetReports().back()));
  }
  if (options.Comparison)
  {
    play.Afresh = make(", shot afresh", true);
    play.Afresh->Show(frames - 1);
  }
  bar.Finish();
  return play;
}

void PrintPower(const FrameReport& last)
{
  char line[160];
  std::snprintf(line, sizeof line,
    "Last frame: %.6g W emitted, %.6g W absorbed, %.6g W escaped from the closed room.\n",
    last.EmittedPower, last.AbsorbedPower, last.EscapedPower);
  std::cout << line;
}

// The promise of the method: whether it was kept.
bool PrintSameness(const Performances& play)
{
  const bool same = HaveSameBits(play.Cached->GetScene(), play.Uncached->GetScene()) &&
    HaveSameBits(play.Cached->GetScene(), play.Afresh->GetScene());
  std::cout << "Updated with cache, without it, and shot afresh, the last frame is "
            << (same ? "the same bit for bit.\n" : "NOT the same.\n");
  return same;
}

bool PrintResults(const Performances& play, const Options& options)
{
  const auto reportsOf = [](const std::unique_ptr<Performance>& performance) {
    return performance ? performance->GetReports() : std::vector<FrameReport>();
  };
  std::cout << '\n';
  WriteTimingTable(
    std::cout, { reportsOf(play.Cached), reportsOf(play.Uncached), reportsOf(play.Afresh) });
  PrintPower(play.Cached->GetReports().back());
  const bool good = !options.Comparison || PrintSameness(play);
  std::cout << "Written to " << options.Output << ": MovingTeapot.pvd"
            << (options.Pictures ? ", MovingTeapot.ogv, pictures/" : "") << std::endl;
  return good;
}

int Run(const Options& options)
{
  if (options.Pictures && !HasDisplay())
  {
    throw std::runtime_error("pictures need an X display and DISPLAY is not set; start it through "
                             "Examples/run.sh or xvfb-run, or add --no-pictures");
  }
  vtkSMPTools::Initialize(options.Threads);
  const TeapotScene scene = MakeScene(options);
  PrintScene(scene, options);
  MakeFolder(options.Output);
  Recording recording(
    { options.Output, options.Pictures, options.Width, options.Height, options.SmoothingPasses });
  const Performances play = Play(scene, options, recording);
  return PrintResults(play, options) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}

int main(int argc, char* argv[])
{
  try
  {
    const Options options = ReadOptions(argc, argv);
    if (options.Help)
    {
      std::cout << HelpText();
      return EXIT_SUCCESS;
    }
    return Run(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << "MovingTeapot: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
