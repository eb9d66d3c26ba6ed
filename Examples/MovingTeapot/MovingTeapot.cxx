// SPDX-License-Identifier: BSD-3-Clause
/**
 * The experiment of L. Szecsi, B. Benedek, L. Szirmay-Kalos, "Accelerating Animation Through
 * Verification of Shooting Walks", section 5, at today's scale: a box with a stationary head and a
 * moving teapot, lit by a lamp, the walls cut into small cells. Every frame brings the irradiance
 * of every cell up to date; at the end stands the paper's table, with its figures beside ours. See
 * README.md in this folder.
 */
#include "Animation.h"
#include "FrameFile.h"
#include "Options.h"
#include "ProgressBar.h"
#include "Recording.h"
#include "SameBits.h"
#include "TimingTable.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

using namespace movingteapot;

namespace
{

// The weight of the first shooting in the progress bar, in updates.
constexpr double ShootingWork = 10.0;

double TimeOf(int frame, int frames)
{
  return double(frame) / (frames - 1);
}

double WorkOf(int frame)
{
  return frame == 0 ? ShootingWork : 1.0;
}

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

std::string CaptionOf(int frame, int frames, const FrameTiming& timing)
{
  char text[120];
  if (frame == 0)
  {
    std::snprintf(text, sizeof text, "Frame 1 of %d: all walks shot", frames);
  }
  else
  {
    std::snprintf(text, sizeof text, "Frame %d of %d: %.1f %% of the path segments shot again",
      frame + 1, frames, 100.0 * timing.RepairedSegments / timing.Segments);
  }
  return text;
}

// Plays the sequence from its first frame; `recording` may be null.
RunTiming Play(
  Animation& animation, int frames, const char* what, ProgressBar& bar, Recording* recording)
{
  RunTiming run;
  animation.SetProgressFunction([&](double fraction) { bar.SetStepFraction(fraction); });
  for (int frame = 0; frame < frames; ++frame)
  {
    bar.BeginStep(WorkOf(frame),
      std::string(what) + ", frame " + std::to_string(frame + 1) + " of " + std::to_string(frames));
    animation.Update(TimeOf(frame, frames));
    run.push_back(animation.GetTiming());
    if (recording)
    {
      recording->Add(
        frame, TimeOf(frame, frames), animation.GetScene(), CaptionOf(frame, frames, run.back()));
    }
    bar.EndStep();
  }
  return run;
}

void PrintPower(const FrameTiming& last)
{
  char line[160];
  std::snprintf(line, sizeof line,
    "Last frame: %.6g W emitted, %.6g W absorbed, %.6g W escaped from the closed room.\n",
    last.EmittedPower, last.AbsorbedPower, last.EscapedPower);
  std::cout << line;
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
  Recording recording({ options.Output, options.Pictures, options.Width, options.Height });
  ProgressBar bar(2 * (ShootingWork + options.Frames - 1) + ShootingWork);

  Animation cached(scene, { options.Walks, options.TraversalMode, true });
  const RunTiming cachedRun = Play(cached, options.Frames, "With cache", bar, &recording);
  Animation uncached(scene, { options.Walks, options.TraversalMode, false });
  const RunTiming uncachedRun = Play(uncached, options.Frames, "Without cache", bar, nullptr);

  bar.BeginStep(ShootingWork, "Last frame shot afresh");
  Animation afresh(scene, { options.Walks, options.TraversalMode, true });
  afresh.Update(1.0);
  bar.EndStep();
  bar.Finish();

  std::cout << '\n';
  WriteTimingTable(std::cout, cachedRun, uncachedRun, afresh.GetTiming().ShootSeconds);
  PrintPower(cachedRun.back());
  const bool same = HaveSameBits(cached.GetScene(), uncached.GetScene()) &&
    HaveSameBits(cached.GetScene(), afresh.GetScene());
  std::cout << "With cache, without it, and shot afresh, the last frame is "
            << (same ? "the same bit for bit" : "NOT the same") << ".\n"
            << "Written to " << options.Output << ": MovingTeapot.pvd"
            << (options.Pictures ? ", MovingTeapot.ogv, pictures/" : "") << std::endl;
  return same ? EXIT_SUCCESS : EXIT_FAILURE;
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
