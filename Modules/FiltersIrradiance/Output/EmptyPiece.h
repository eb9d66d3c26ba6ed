// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_EmptyPiece_h
#define irradiance_EmptyPiece_h

#include "vtkSmartPointer.h"

#include <functional>

class vtkDataObject;
class vtkDataObjectTree;
class vtkDataSet;
class vtkPolyData;

/// What outputs are where they have no cells, see isEmptyPieceRequested(). What reads their arrays
/// by name, or counts bands, finds the same as elsewhere.
namespace irradiance
{

/// Gives a data set without points the arrays of another, without values.
void copyEmptyArrays(vtkDataSet* from, vtkDataSet* to);

/// Takes points and cells from data, and the field data of the root.
void removeElements(vtkDataObject* data);

/// Polydata with the arrays of another, without points and cells.
vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* polyData);

/// Makes `empty` a tree with polydata without cells; add() gives each further arrays.
void emptyLeaves(
  vtkDataObjectTree* tree, vtkDataObjectTree* empty, const std::function<void(vtkPolyData*)>& add);

/// Number of components that the irradiance has in polydata, or in the first leaf of a tree of
/// them; else 1.
int bandsOf(vtkDataObject* data);
/// Whether there are standard errors of the irradiance.
bool haveErrors(vtkDataObject* data);
/// Whether there is an array of what a light group brings.
bool haveGroup(vtkDataObject* data, const std::string& group);

}

#endif
