// SPDX-License-Identifier: BSD-3-Clause
// Feeds files to a fuzz target without a fuzzer: Replay<target> FILE_OR_FOLDER... A target aborts
// if something is wrong; the last name printed is the culprit's.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{

using Path = std::filesystem::path;

std::vector<Path> filesOf(const Path& path)
{
  std::vector<Path> files;
  if (!std::filesystem::is_directory(path))
  {
    return { path };
  }
  for (const auto& entry : std::filesystem::directory_iterator(path))
  {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool replay(const Path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    std::fprintf(stderr, "%s cannot be read\n", path.c_str());
    return false;
  }
  std::vector<char> text{ std::istreambuf_iterator<char>(file), {} };
  std::printf("%s\n", path.c_str());
  std::fflush(stdout);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  return true;
}

}

int main(int count, char** arguments)
{
  int replayed = 0;
  for (int i = 1; i < count; ++i)
  {
    for (const Path& path : filesOf(arguments[i]))
    {
      if (!replay(path))
      {
        return 1;
      }
      ++replayed;
    }
  }
  std::printf("%d files\n", replayed);
  return replayed > 0 ? 0 : 1;
}
