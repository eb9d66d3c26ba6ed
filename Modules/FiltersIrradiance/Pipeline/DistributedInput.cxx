// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/DistributedInput.h"

#include "Data/NamedArray.h"
#include "Input/ChosenArrays.h"
#include "Input/Pose.h"
#include "Progress/InputError.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <numeric>
#include <set>

namespace irradiance
{

namespace
{

using Parts = std::vector<InputPart*>;
using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

constexpr const char* kMark = "vtkIrradiancePieceCell";
/// Its components; kGlobalId -1: none.
constexpr int kProcess = 0, kCellOfPiece = 1, kGlobalId = 2, kMarkComponents = 3;

/// Doubles by their bits: a total order, with NaN in it.
std::int64_t keyOf(double coordinate)
{
  std::int64_t bits;
  std::memcpy(&bits, &coordinate, sizeof(bits));
  return bits;
}

/// Compares cells of one polydata.
class CellOrder
{
public:
  explicit CellOrder(vtkPolyData* cells)
    : cells_(cells)
    , marks_(vtkIdTypeArray::SafeDownCast(cells->GetCellData()->GetArray(kMark)))
  {
    const std::array<vtkIdType, kKinds> counts{ cells->GetNumberOfVerts(),
      cells->GetNumberOfLines(), cells->GetNumberOfPolys(), cells->GetNumberOfStrips() };
    std::partial_sum(counts.begin(), counts.end(), ends_.begin());
  }

  static constexpr std::size_t kKinds = 4; ///< vertices, lines, polygons, strips
  /// Which of these a cell is: polydata numbers them in this order.
  std::size_t kindOf(vtkIdType cell) const
  {
    return static_cast<std::size_t>(
      std::upper_bound(ends_.begin(), ends_.end(), cell) - ends_.begin());
  }
  vtkIdType mark(vtkIdType cell, int component) const
  {
    return marks_->GetTypedComponent(cell, component);
  }

  bool operator()(vtkIdType a, vtkIdType b) const
  {
    if (kindOf(a) != kindOf(b))
    {
      return kindOf(a) < kindOf(b);
    }
    if (mark(a, kGlobalId) != mark(b, kGlobalId))
    {
      return mark(a, kGlobalId) < mark(b, kGlobalId);
    }
    const int places = comparePlaces(a, b);
    return places != 0 ? places < 0
                       : std::array{ mark(a, kProcess), mark(a, kCellOfPiece) } <
        std::array{ mark(b, kProcess), mark(b, kCellOfPiece) };
  }

private:
  /// Below 0 if a comes first.
  int comparePlaces(vtkIdType a, vtkIdType b) const
  {
    vtkIdType count, otherCount;
    const vtkIdType *ids, *otherIds;
    cells_->GetCellPoints(a, count, ids);
    cells_->GetCellPoints(b, otherCount, otherIds);
    if (count != otherCount)
    {
      return count < otherCount ? -1 : 1;
    }
    for (vtkIdType i = 0; i < count; ++i)
    {
      std::array<double, 3> p, q;
      cells_->GetPoint(ids[i], p.data());
      cells_->GetPoint(otherIds[i], q.data());
      for (std::size_t axis = 0; axis < p.size(); ++axis)
      {
        const std::int64_t first = keyOf(p[axis]), second = keyOf(q[axis]);
        if (first != second)
        {
          return first < second ? -1 : 1;
        }
      }
    }
    return 0;
  }

  vtkPolyData* cells_;
  vtkIdTypeArray* marks_;
  std::array<vtkIdType, kKinds> ends_;
};

/// The cells of a piece and their arrays, each cell marked with the process that holds it.
vtkSmartPointer<vtkPolyData> markedPiece(vtkPolyData* piece, std::uint32_t rank)
{
  auto marked = vtkSmartPointer<vtkPolyData>::New();
  marked->CopyStructure(piece);
  marked->GetCellData()->ShallowCopy(piece->GetCellData());
  const auto marks = addArray<vtkIdTypeArray>(
    marked->GetCellData(), kMark, kMarkComponents, piece->GetNumberOfCells());
  vtkDataArray* ids = piece->GetCellData()->GetGlobalIds();
  for (vtkIdType i = 0; i < piece->GetNumberOfCells(); ++i)
  {
    marks->SetTypedComponent(i, kProcess, static_cast<vtkIdType>(rank));
    marks->SetTypedComponent(i, kCellOfPiece, i);
    marks->SetTypedComponent(i, kGlobalId, ids ? static_cast<vtkIdType>(ids->GetTuple1(i)) : -1);
  }
  return marked;
}

/// Orders cells of marked pieces: vertices, lines, polygons and strips, as polydata do; each of
/// these by global id, if there are such ids, by the coordinates of the points, and by process. So
/// cells of one place with one id alone depend on who held them. `cells`: where each cell of this
/// rank's piece has gone.
vtkSmartPointer<vtkPolyData> orderedByPlace(
  vtkPolyData* marked, std::uint32_t rank, std::vector<std::size_t>& cells)
{
  marked->BuildCells();
  const CellOrder order(marked);
  const vtkIdType count = marked->GetNumberOfCells();
  std::vector<vtkIdType> sorted(static_cast<std::size_t>(count));
  std::iota(sorted.begin(), sorted.end(), vtkIdType{});
  std::sort(sorted.begin(), sorted.end(), order);

  auto ordered = vtkSmartPointer<vtkPolyData>::New();
  ordered->SetPoints(marked->GetPoints());
  std::array<vtkNew<vtkCellArray>, CellOrder::kKinds> kinds;
  vtkCellData* data = ordered->GetCellData();
  data->CopyAllocate(marked->GetCellData(), count);
  cells.assign(
    static_cast<std::size_t>(std::count_if(sorted.begin(), sorted.end(),
      [&](vtkIdType cell) { return order.mark(cell, kProcess) == static_cast<vtkIdType>(rank); })),
    0);
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const vtkIdType cell = sorted[i];
    vtkIdType size;
    const vtkIdType* points;
    marked->GetCellPoints(cell, size, points);
    kinds[order.kindOf(cell)]->InsertNextCell(size, points);
    data->CopyData(marked->GetCellData(), cell, static_cast<vtkIdType>(i));
    if (order.mark(cell, kProcess) == static_cast<vtkIdType>(rank))
    {
      cells[static_cast<std::size_t>(order.mark(cell, kCellOfPiece))] = i;
    }
  }
  ordered->SetVerts(kinds[0]);
  ordered->SetLines(kinds[1]);
  ordered->SetPolys(kinds[2]);
  ordered->SetStrips(kinds[3]);
  data->RemoveArray(kMark);
  return ordered;
}

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
void checkArrays(const std::string& name, const Pieces& pieces)
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
Pieces piecesOf(const InputPart& part, ControllerRanks& ranks)
{
  const auto own =
    part.piece->GetNumberOfCells() > 0 ? markedPiece(part.piece, ranks.rank()) : nullptr;
  Pieces pieces;
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

/// Puts the pieces of a part together. `cells`: of this rank's piece.
vtkSmartPointer<vtkPolyData> wholeOf(
  Pieces pieces, const Ranks& ranks, std::vector<std::size_t>& cells)
{
  if (pieces.empty())
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  std::uint32_t holder = ranks.rank();
  if (pieces.size() == ranks.count() &&
    std::all_of(pieces.begin(), pieces.end(),
      [&](vtkPolyData* piece) { return haveSameCells(piece, pieces.front()); }))
  {
    // Each process has all of it: a lamp that each has made, or a source that knows no pieces.
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

/// The pose of a part is that of the first process that has cells of it: one without may know none.
void sharePoses(const Parts& parts, Ranks& ranks)
{
  std::array<std::int64_t, 16> bits; // of the matrix of a pose
  std::vector<std::int64_t> own;     // for each part, whether there are cells, and its pose
  for (const InputPart* part : parts)
  {
    std::memcpy(bits.data(), matrixOf(part->worldFromPart).data(), sizeof(bits));
    own.push_back(part->piece->GetNumberOfCells() > 0 ? 1 : 0);
    own.insert(own.end(), bits.begin(), bits.end());
  }
  const std::vector<std::int64_t> all = ranks.concatenate(own);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    std::size_t first = i * (1 + bits.size());
    while (first < all.size() && all[first] == 0)
    {
      first += own.size();
    }
    if (first < all.size())
    {
      std::array<double, 16> matrix;
      std::memcpy(matrix.data(), &all[first + 1], sizeof(matrix));
      parts[i]->worldFromPart = poseOf(parts[i]->name, matrix.data());
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
