// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFolder.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <stdexcept>
#include <vector>

namespace movingteapot
{

namespace fs = std::filesystem;

void PrepareFolder(const std::string& folder, const std::string& ours)
{
  try
  {
    fs::create_directories(folder);
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    {
      if (std::regex_match(fs::relative(entry.path(), folder).generic_string(), std::regex(ours)))
      {
        found.push_back(entry.path());
      }
    }
    std::sort(found.rbegin(), found.rend()); // what is in a folder comes before it
    for (const fs::path& path : found)
    {
      if (!fs::is_directory(path) || fs::is_empty(path))
      {
        fs::remove(path);
      }
    }
  }
  catch (const fs::filesystem_error& error)
  {
    throw std::runtime_error(
      "--output: " + folder + ": this folder cannot be used: " + error.code().message());
  }
}

void AddParaViewState(const std::string& folder)
{
  std::ofstream state(fs::path(folder) / "ParaViewState.py");
  state << "FOLDER = " << fs::absolute(folder) << '\n' << std::ifstream(PARAVIEW_STATE).rdbuf();
  if (!state.flush())
  {
    throw std::runtime_error("--output: " + folder + "/ParaViewState.py cannot be written");
  }
}

bool CanDraw()
{
  const char* display = std::getenv("DISPLAY");
  const bool canDraw =
    !vtkNew<vtkRenderWindow>()->IsA("vtkXOpenGLRenderWindow") || (display && *display);
  if (!canDraw)
  {
    std::cerr << "No pictures: DISPLAY is not set, and VTK needs an X display; Examples/run.sh and "
                 "xvfb-run start one.\n";
  }
  return canDraw;
}

}
