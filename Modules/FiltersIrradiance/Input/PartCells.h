// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneCells.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// Numbers of cells in a whole, in the order of a piece of it; null: the piece is the whole.
using PieceCells = std::shared_ptr<const std::vector<std::size_t>>;

/// Which cells of the scene a polydata has.
struct PartCells
{
  SceneCell first; ///< of the part to which the polydata belongs
  PieceCells piece;

  SceneCell operator[](vtkIdType i) const
  {
    const auto cell = static_cast<std::size_t>(i);
    return { first.object, first.cell + (piece ? (*piece)[cell] : cell) };
  }
};

/// Calls visit(number of points, their ids) for all cells.
template <class Visit>
void forEachCell(vtkCellArray* cells, const Visit& visit)
{
  const auto it = vtk::TakeSmartPointer(cells->NewIterator());
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    it->GetCurrentCell(count, ids);
    visit(count, ids);
  }
}

}
