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
#include "OutputFolder.h"
#include "ProgressBar.h"
#include "Recording.h"
#include "TimingTable.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

using namespace movingteapot;

namespace
{

TeapotScene MakeScene(SceneConfig config)
{
  const char* head = MOVINGTEAPOT_DATA "/downloaded/mannequin-devil.off";
  if (config.HeadFile.empty() && vtksys::SystemTools::FileExists(head, true))
  {
    config.HeadFile = head;
  }
  if (config.HeadFile.empty())
  {
    std::cerr << "The plinth stays empty: Data/fetch.sh gets the head, or --head takes another.\n";
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
  char share[80];
  std::snprintf(share, sizeof share, "%.1f %% of the path segments shot again",
    100.0 * LastOf(animation, "NumberOfRepairedSegments") / LastOf(animation, "NumberOfSegments"));
  return "Frame " + std::to_string(frame + 1) + " of " + std::to_string(frames) + ": " +
    (frame == 0 ? "all walks shot" : share);
}

// The irradiance of all cells, byte for byte.
std::string BytesOf(Animation& animation)
{
  std::string bytes;
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(animation.GetScene()))
  {
    vtkDataArray* irradiance = mesh->GetCellData()->GetArray("Irradiance");
    bytes.append(static_cast<const char*>(irradiance->GetVoidPointer(0)),
      irradiance->GetNumberOfValues() * irradiance->GetDataTypeSize());
  }
  return bytes;
}

// The promise of the method: whether it was kept.
bool PrintSameness(Animation& cached, Animation& uncached, Animation& afresh)
{
  const std::string updated = BytesOf(cached);
  const bool same = !updated.empty() && updated == BytesOf(uncached) && updated == BytesOf(afresh);
  std::printf("Updated with cache, without it, and shot afresh, the last frame is %s.\n",
    same ? "the same bit for bit" : "NOT the same");
  return same;
}

int Run(const Options& options)
{
  vtkSMPTools::Initialize(options.Threads);
  const TeapotScene scene = MakeScene(options.Scene);
  PrintScene(scene, options);
  Recording recording(options);

  const int last = options.Frames - 1;
  const double work = Animation::ShootingWork + Animation::UpdateWork * last;
  ProgressBar bar(options.Comparison ? 2 * work + Animation::ShootingWork : work);
  Animation cached("", scene, options, true, bar);
  Animation uncached(", without cache", scene, options, false, bar);
  Animation afresh(", shot afresh", scene, options, true, bar);
  for (int frame = 0; frame <= last; ++frame)
  {
    std::vector<Animation*> inTurn = { &cached };
    if (options.Comparison) // neither is always the first
    {
      inTurn.insert(frame % 2 ? inTurn.begin() : inTurn.end(), &uncached);
    }
    for (Animation* animation : inTurn)
    {
      animation->Show(frame);
    }
    recording.Add(
      frame, cached.TimeOf(frame), cached.GetScene(), CaptionOf(frame, last + 1, cached));
  }
  if (options.Comparison)
  {
    afresh.Show(last);
  }
  bar.Finish();

  PrintTimingTable(cached.GetReports(), uncached.GetReports(), afresh.GetReports());
  std::printf("Last frame: %.6g W emitted, %.6g W absorbed, %.6g W escaped from the closed room.\n",
    LastOf(cached, "EmittedPower"), LastOf(cached, "AbsorbedPower"),
    LastOf(cached, "EscapedPower"));
  const bool good = !options.Comparison || PrintSameness(cached, uncached, afresh);
  std::printf("Written to %s: MovingTeapot.pvd, ParaViewState.py%s\n", options.Output.c_str(),
    options.Pictures ? ", MovingTeapot.ogv, pictures/" : "");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}

int main(int argc, char* argv[])
{
  try
  {
    Options options = ReadOptions({ argv + 1, argv + argc });
    if (options.Help)
    {
      std::cout << HelpText();
      return EXIT_SUCCESS;
    }
    options.Pictures = options.Pictures && CanDraw();
    return Run(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << "MovingTeapot: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
