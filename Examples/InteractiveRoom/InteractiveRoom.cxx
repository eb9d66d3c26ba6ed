// SPDX-License-Identifier: BSD-3-Clause
/**
 * A lit room in a window. The user moves things with the mouse or the keys; the light follows
 * within a budget of time, and is exact soon after. See README.md in this folder.
 */
#include "DragTiming.h"
#include "EventFile.h"
#include "Film.h"
#include "LightFollower.h"
#include "OutputFolder.h"
#include "RoomOptions.h"
#include "RoomPresets.h"
#include "RoomWindow.h"
#include "UserMeshes.h"
#include "VtkErrors.h"

#include <vtkInteractorEventRecorder.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

using namespace interactiveroom;

namespace
{

Room MakeRoom(const RoomOptions& options)
{
  return options.Moving.empty() ? MakePreset(options.Preset)
                                : ReadUserRoom(options.Still, options.Moving, options.Unit);
}

void PrintRoom(const Room& room, const RoomOptions& options)
{
  vtkIdType still = 0, moving = 0;
  for (const StillThing& thing : room.Still)
  {
    still += thing.Mesh->GetNumberOfCells();
  }
  for (const MovingThing& thing : room.Moving)
  {
    moving += thing.Mesh->GetNumberOfCells();
  }
  std::cout << still << " cells stay, " << moving << " cells of " << room.Moving.size()
            << " things move; " << options.Walks << " walks, "
            << vtkSMPTools::GetEstimatedNumberOfThreads() << " threads." << std::endl;
}

void Play(RoomWindow& window, const RoomOptions& options)
{
  Film film(options.Output, window.GetWindow());
  if (options.Movie)
  {
    window.OnRendered([&film] { film.AddFrame(); });
  }
  PlayEvents(options.Events, window.GetInteractor());
  window.Settle();
  film.WritePicture();
  std::cout << "Written to " << options.Output << ": InteractiveRoom.png"
            << (options.Movie ? ", InteractiveRoom.ogv\n" : "\n");
}

void Record(RoomWindow& window, const RoomOptions& options)
{
  const auto recorder = RecordEvents(options.Record, window.GetInteractor());
  const movingteapot::VtkErrors
    unheard; // the recorder ends itself at q, and VTK warns of how it does so
  window.Run();
  recorder->Off();
  std::cout << "Written: " << options.Record << "\n";
}

// What can be said without a window.
void PrintLight(LightFollower& light, const Room& room)
{
  light.Shoot({});
  std::printf("%.6g W emitted; standard error of a cell: %.1f %% of the mean.\n"
              "To move things takes a window on a display of yours; --events plays on any.\n",
    light.GetFilter()->GetFigure("EmittedPower"), 100 * MeanError(room).Of(light.GetScene()));
  std::fflush(stdout);
}

void Show(const Room& room, LightFollower& light, const RoomOptions& options)
{
  RoomWindow window(room, light, options);
  if (!options.Events.empty())
  {
    window.HideFrameRate();
  }
  window.Shoot();
  if (!options.Events.empty())
  {
    Play(window, options);
  }
  else if (!options.Record.empty())
  {
    Record(window, options);
  }
  else if (options.Frames > 0)
  {
    PrintDragTiming(window, light, options.Frames);
  }
  else
  {
    window.Run();
  }
}

void Run(const RoomOptions& options)
{
  vtkSMPTools::Initialize(options.Threads);
  const Room room = MakeRoom(options);
  PrintRoom(room, options);
  LightFollower light(room, options.Walks, options.GatherRays);
  const bool canDraw = movingteapot::CanDraw();
  if (canDraw)
  {
    Show(room, light, options);
  }
  else
  {
    PrintLight(light, room);
  }
}

}

int main(int argc, char* argv[])
{
  try
  {
    const RoomOptions options = ReadOptions({ argv + 1, argv + argc });
    if (options.Help)
    {
      std::cout << HelpText();
    }
    else
    {
      Run(options);
    }
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << "InteractiveRoom: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
