// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>
#include <vtkWindowToImageFilter.h>

#include <string>

class vtkRenderWindow;

namespace interactiveroom
{

/** The pictures of a window in a folder: InteractiveRoom.ogv, and the last one as InteractiveRoom.png. */
class Film
{
public:
  /** Throws std::runtime_error that names the folder. */
  Film(const std::string& folder, vtkRenderWindow* window);
  ~Film();

  void AddFrame();
  void WritePicture();

private:
  std::string Folder;
  vtkNew<vtkWindowToImageFilter> Grabber;
  vtkNew<vtkOggTheoraWriter> Movie;
  bool IsStarted = false;
};

}
