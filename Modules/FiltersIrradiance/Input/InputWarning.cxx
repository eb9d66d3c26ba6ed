// SPDX-License-Identifier: BSD-3-Clause
#include "Input/InputWarning.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

void InputWarnings::add(const InputWarning& warning)
{
  auto kind = std::find_if(kinds_.begin(), kinds_.end(),
    [&](const auto& some) { return some.first.what == warning.what; });
  if (kind == kinds_.end())
  {
    kind = kinds_.insert(kind, { warning, {} });
  }
  kind->second[warning.input] = warning.cells;
}

std::vector<std::string> InputWarnings::take()
{
  std::vector<std::string> texts;
  for (const auto& [first, cells] : std::exchange(kinds_, {}))
  {
    const bool isOfCells = first.cells > 0;
    std::string text =
      first.input + (isOfCells ? ": " + std::to_string(first.cells) + " cells " : "") + first.what;
    if (isOfCells)
    {
      text += ", the first is cell " + std::to_string(first.firstCell) + "; " + first.consequence;
    }
    if (cells.size() > 1)
    {
      const vtkIdType all = std::accumulate(cells.begin(), cells.end(), vtkIdType{},
        [](vtkIdType sum, const auto& some) { return sum + some.second; });
      text += " (there are " + std::to_string(cells.size()) + " such inputs" +
        (isOfCells ? ", with " + std::to_string(all) + " such cells" : "") + ")";
    }
    texts.push_back(text);
  }
  return texts;
}

}
