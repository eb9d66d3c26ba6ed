// SPDX-License-Identifier: BSD-3-Clause
#include "FrameFile.h"

#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <stdexcept>

namespace movingteapot
{

std::string FrameFile(const std::string& name, std::size_t frame, const std::string& extension)
{
  char number[32];
  std::snprintf(number, sizeof number, "_%04zu.", frame);
  return name + number + extension;
}

void MakeFolder(const std::string& path)
{
  if (!vtksys::SystemTools::MakeDirectory(path))
  {
    throw std::runtime_error(path + ": this folder cannot be made");
  }
}

}
