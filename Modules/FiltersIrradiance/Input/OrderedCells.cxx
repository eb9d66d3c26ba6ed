// SPDX-License-Identifier: BSD-3-Clause
#include "Input/OrderedCells.h"

#include "Data/NamedArray.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace irradiance
{

namespace
{

constexpr const char* kMark = "vtkIrradiancePieceCell";
enum MarkComponent
{
  Process,
  CellOfPiece,
  GlobalId, ///< -1: none
  kMarkComponents
};

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
  vtkIdType mark(vtkIdType cell, MarkComponent component) const
  {
    return marks_->GetTypedComponent(cell, component);
  }

  bool operator()(vtkIdType a, vtkIdType b) const
  {
    if (kindOf(a) != kindOf(b))
    {
      return kindOf(a) < kindOf(b);
    }
    if (mark(a, GlobalId) != mark(b, GlobalId))
    {
      return mark(a, GlobalId) < mark(b, GlobalId);
    }
    const int places = comparePlaces(a, b);
    return places != 0 ? places < 0
                       : std::array{ mark(a, Process), mark(a, CellOfPiece) } <
        std::array{ mark(b, Process), mark(b, CellOfPiece) };
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

}

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
    marks->SetTypedComponent(i, Process, static_cast<vtkIdType>(rank));
    marks->SetTypedComponent(i, CellOfPiece, i);
    marks->SetTypedComponent(i, GlobalId, ids ? static_cast<vtkIdType>(ids->GetTuple1(i)) : -1);
  }
  return marked;
}

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
      [&](vtkIdType cell) { return order.mark(cell, Process) == static_cast<vtkIdType>(rank); })),
    0);
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    const vtkIdType cell = sorted[i];
    vtkIdType size;
    const vtkIdType* points;
    marked->GetCellPoints(cell, size, points);
    kinds[order.kindOf(cell)]->InsertNextCell(size, points);
    data->CopyData(marked->GetCellData(), cell, static_cast<vtkIdType>(i));
    if (order.mark(cell, Process) == static_cast<vtkIdType>(rank))
    {
      cells[static_cast<std::size_t>(order.mark(cell, CellOfPiece))] = i;
    }
  }
  ordered->SetVerts(kinds[0]);
  ordered->SetLines(kinds[1]);
  ordered->SetPolys(kinds[2]);
  ordered->SetStrips(kinds[3]);
  data->RemoveArray(kMark);
  return ordered;
}

}
