// SPDX-License-Identifier: BSD-3-Clause
#ifndef FrameFile_h
#define FrameFile_h

#include <cstddef>
#include <string>

namespace movingteapot
{

/** name_0007.extension for frame 7: sorts by name as by time. */
std::string FrameFile(const std::string& name, std::size_t frame, const std::string& extension);

/** Makes the folder and those above it, if need be; throws std::runtime_error when it cannot. */
void MakeFolder(const std::string& path);

}

#endif
