// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/DistributedInput.h"

#include "Input/ChosenArrays.h"
#include "Input/OrderedCells.h"
#include "Progress/InputError.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <set>

namespace irradiance
{

namespace
{

using Parts = std::vector<InputPart*>;

/// As in "RadiantExitance (double, 3)"; what pieces with the same arrays have in common.
std::set<std::string> arraysOf(vtkPolyData* piece)
{
  std::set<std::string> names;
  vtkCellData* cells = piece->GetCellData();
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = cells->GetAbstractArray(i);
    names.insert(std::string(array->GetName() ? array->GetName() : "") + " (" +
      array->GetDataTypeAsString() + ", " + std::to_string(array->GetNumberOfComponents()) + ")");
  }
  return names;
}

/// Arrays that are not in all pieces would be lost.
void checkArrays(const std::string& name, const std::vector<vtkSmartPointer<vtkPolyData>>& pieces)
{
  for (const auto& piece : pieces)
  {
    std::vector<std::string> differing;
    const auto first = arraysOf(pieces.front()), other = arraysOf(piece);
    std::set_symmetric_difference(
      first.begin(), first.end(), other.begin(), other.end(), std::back_inserter(differing));
    if (!differing.empty())
    {
      throw InputError(name + ": not all pieces of it have the cell array " + differing.front());
    }
  }
}

/// The pieces of all processes that have cells, marked with whose they are.
std::vector<vtkSmartPointer<vtkPolyData>> piecesOf(const InputPart& part, ControllerRanks& ranks)
{
  const auto own =
    part.piece->GetNumberOfCells() > 0 ? markedPiece(part.piece, ranks.rank()) : nullptr;
  std::vector<vtkSmartPointer<vtkPolyData>> pieces;
  for (const auto& piece : ranks.dataOfAll(own))
  {
    pieces.emplace_back(vtkPolyData::SafeDownCast(piece));
  }
  return pieces;
}

/// Where the points of a cell are.
std::vector<std::array<double, 3>> placesOf(vtkPolyData* piece, vtkIdType cell)
{
  vtkIdType count;
  const vtkIdType* points;
  piece->GetCellPoints(cell, count, points);
  std::vector<std::array<double, 3>> places(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    piece->GetPoint(points[i], places[static_cast<std::size_t>(i)].data());
  }
  return places;
}

bool haveSameCells(vtkPolyData* a, vtkPolyData* b)
{
  a->BuildCells();
  b->BuildCells();
  bool isSame = a->GetNumberOfCells() == b->GetNumberOfCells();
  for (vtkIdType i = 0; isSame && i < a->GetNumberOfCells(); ++i)
  {
    isSame = placesOf(a, i) == placesOf(b, i);
  }
  return isSame;
}

/// Whether each process has all of a part, such as a lamp that each has made, or a source that
/// knows no pieces.
bool isWholeOnEach(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces, const Ranks& ranks)
{
  return pieces.size() == ranks.count() &&
    std::all_of(pieces.begin(), pieces.end(),
      [&](vtkPolyData* piece) { return haveSameCells(piece, pieces.front()); });
}

/// Puts the pieces of a part together. `cells`: of this rank's piece.
vtkSmartPointer<vtkPolyData> wholeOf(std::vector<vtkSmartPointer<vtkPolyData>> pieces,
  const Ranks& ranks, std::vector<std::size_t>& cells)
{
  if (pieces.empty())
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  std::uint32_t holder = ranks.rank();
  if (isWholeOnEach(pieces, ranks))
  {
    pieces.resize(1);
    holder = 0;
  }
  vtkNew<vtkAppendPolyData> append;
  for (const auto& piece : pieces)
  {
    append->AddInputData(piece);
  }
  append->Update();
  return orderedByPlace(append->GetOutput(), holder, cells);
}

/// The bits of the numbers of a map.
using MapBits = std::array<std::int64_t, 12>;

MapBits bitsOf(const AffineMap& map)
{
  MapBits bits;
  std::memcpy(bits.data(), map.linear.data(), 9 * sizeof(double));
  std::memcpy(bits.data() + 9, map.translation.data(), 3 * sizeof(double));
  return bits;
}

AffineMap mapOf(const std::int64_t* bits)
{
  AffineMap map;
  std::memcpy(map.linear.data(), bits, 9 * sizeof(double));
  std::memcpy(map.translation.data(), bits + 9, 3 * sizeof(double));
  return map;
}

/// The pose of a part is that of the first process that has cells of it: one without may know none.
void sharePoses(const Parts& parts, Ranks& ranks)
{
  std::vector<std::int64_t> own; // for each part, whether there are cells, and its pose
  for (const InputPart* part : parts)
  {
    const MapBits bits = bitsOf(part->worldFromPart);
    own.push_back(part->piece->GetNumberOfCells() > 0 ? 1 : 0);
    own.insert(own.end(), bits.begin(), bits.end());
  }
  const std::vector<std::int64_t> all = ranks.concatenate(own);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    std::size_t first = i * (1 + MapBits().size());
    while (first < all.size() && all[first] == 0)
    {
      first += own.size();
    }
    if (first < all.size())
    {
      parts[i]->worldFromPart = mapOf(&all[first + 1]);
    }
  }
}

}

void DistributedInput::complete(vtkAlgorithm* filter, ControllerRanks& ranks, SceneInputs& inputs)
{
  const Parts parts = allPartsOf(inputs);
  ranks.expectSame(
    parts.size(), "another number of inputs, or of blocks in them, than on the first process");
  wholes_.resize(parts.size());
  std::vector<std::int64_t> changed(parts.size());
  std::transform(parts.begin(), parts.end(), wholes_.begin(), changed.begin(),
    [](InputPart* part, const Whole& whole) {
      vtkPolyData* origin = originOfGeometry(part->polyData);
      return whole.piece == origin && whole.time == origin->GetMTime() ? 0 : 1;
    });
  ranks.sum(changed.data(), changed.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    InputPart& part = *parts[i];
    Whole& whole = wholes_[i];
    if (changed[i] > 0)
    {
      whole = {};
      const auto pieces = piecesOf(part, ranks);
      vtkPolyData* origin = originOfGeometry(part.polyData);
      std::vector<std::size_t> cells;
      checkArrays(part.name, pieces);
      const auto polyData = wholeOf(pieces, ranks, cells);
      whole = { origin, origin->GetMTime(), polyData,
        std::make_shared<const std::vector<std::size_t>>(std::move(cells)) };
    }
    part.polyData = whole.polyData;
    part.cells = whole.cells;
    findArrays(filter, part);
  }
  sharePoses(parts, ranks);
}

}
