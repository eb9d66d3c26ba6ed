// SPDX-License-Identifier: BSD-3-Clause
/**
 * The experiment of L. Szecsi, B. Benedek, L. Szirmay-Kalos, "Accelerating Animation Through
 * Verification of Shooting Walks", section 5, at today's scale: a box with a stationary head and a
 * moving teapot, lit by a lamp, the walls cut into small cells. Every frame brings the irradiance
 * of every cell up to date; at the end stands the paper's table, with its figures beside ours. See
 * README.md in this folder.
 */
#include "Animation.h"
#include "Options.h"
#include "ProgressBar.h"
#include "Recording.h"
#include "TimingTable.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace movingteapot;

namespace
{

TeapotScene MakeScene(const Options& options)
{
  SceneConfig config;
  config.CellSize = options.CellSize;
  config.TeapotSegments = options.TeapotSegments;
  config.TeapotFile = options.TeapotFile;
  config.HeadFile = options.HeadFile.empty() ? MOVINGTEAPOT_DATA "/downloaded/mannequin-devil.off"
                                             : options.HeadFile;
  if (options.HeadFile.empty() && !vtksys::SystemTools::FileExists(config.HeadFile, true))
  {
    std::cerr << "The plinth stays empty: Data/fetch.sh gets the head, or --head takes another.\n";
    config.HeadFile = "";
  }
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

double LastOf(Animation& animation, const char* name)
{
  vtkFieldData* reports = animation.GetReports();
  return reports->GetArray(name)->GetTuple1(reports->GetNumberOfTuples() - 1);
}

std::string CaptionOf(int frame, int frames, Animation& animation)
{
  char text[120];
  std::snprintf(text, sizeof text, "Frame %d of %d: ", frame + 1, frames);
  std::string caption = text;
  std::snprintf(text, sizeof text, "%.1f %% of the path segments shot again",
    100.0 * LastOf(animation, "NumberOfRepairedSegments") / LastOf(animation, "NumberOfSegments"));
  return caption + (frame == 0 ? "all walks shot" : text);
}

// What is compared at the end; Uncached and Afresh are null without a comparison.
struct Animations
{
  std::unique_ptr<Animation> Cached, Uncached, Afresh;
};

Animations Play(const TeapotScene& scene, const Options& options, Recording& recording)
{
  const double work = Animation::ShootingWork + Animation::UpdateWork * (options.Frames - 1);
  ProgressBar bar(options.Comparison ? 2 * work + Animation::ShootingWork : work);
  const auto make = [&](const char* name, bool cacheStaticHits) {
    return std::make_unique<Animation>(name, scene, options, cacheStaticHits, bar);
  };

  Animations play;
  play.Cached = make("", true);
  std::vector<Animation*> inTurn = { play.Cached.get() };
  if (options.Comparison)
  {
    play.Uncached = make(", without cache", false);
    inTurn.push_back(play.Uncached.get());
  }
  for (int frame = 0; frame < options.Frames; ++frame)
  {
    for (Animation* animation : inTurn)
    {
      animation->Show(frame);
    }
    std::reverse(inTurn.begin(), inTurn.end()); // neither is always the first
    recording.Add(frame, play.Cached->TimeOf(frame), play.Cached->GetScene(),
      CaptionOf(frame, options.Frames, *play.Cached));
  }
  if (options.Comparison)
  {
    play.Afresh = make(", shot afresh", true);
    play.Afresh->Show(options.Frames - 1);
  }
  bar.Finish();
  return play;
}

// Of all cells, one mesh after the other.
std::vector<double> IrradianceOf(Animation& animation)
{
  std::vector<double> all;
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(animation.GetScene()))
  {
    auto* irradiance = vtkDoubleArray::SafeDownCast(mesh->GetCellData()->GetArray("Irradiance"));
    all.insert(all.end(), irradiance->Begin(), irradiance->End());
  }
  return all;
}

bool HaveSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// The promise of the method: whether it was kept.
bool PrintSameness(const Animations& play)
{
  const std::vector<double> updated = IrradianceOf(*play.Cached);
  const bool same = HaveSameBits(updated, IrradianceOf(*play.Uncached)) &&
    HaveSameBits(updated, IrradianceOf(*play.Afresh));
  std::cout << "Updated with cache, without it, and shot afresh, the last frame is "
            << (same ? "the same bit for bit.\n" : "NOT the same.\n");
  return same;
}

bool PrintResults(const Animations& play, const Options& options)
{
  const auto reportsOf = [](const std::unique_ptr<Animation>& animation) {
    return animation ? animation->GetReports() : nullptr;
  };
  std::cout << '\n';
  WriteTimingTable(
    std::cout, { reportsOf(play.Cached), reportsOf(play.Uncached), reportsOf(play.Afresh) });
  std::cout << "Last frame: " << LastOf(*play.Cached, "EmittedPower") << " W emitted, "
            << LastOf(*play.Cached, "AbsorbedPower") << " W absorbed, "
            << LastOf(*play.Cached, "EscapedPower") << " W escaped from the closed room.\n";
  const bool good = !options.Comparison || PrintSameness(play);
  std::cout << "Written to " << options.Output << ": MovingTeapot.pvd"
            << (options.Pictures ? ", MovingTeapot.ogv, pictures/" : "") << std::endl;
  return good;
}

int Run(const Options& options)
{
  vtkSMPTools::Initialize(options.Threads);
  const TeapotScene scene = MakeScene(options);
  PrintScene(scene, options);
  Recording recording(options);
  const Animations play = Play(scene, options, recording);
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
