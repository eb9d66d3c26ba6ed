// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_EmptyPiece_h
#define irradiance_EmptyPiece_h

#include "vtkSmartPointer.h"

class vtkDataObject;
class vtkDataSetAttributes;
class vtkInformation;
class vtkPolyData;

namespace irradiance
{

/**
 * When n processes share a pipeline, each asks for its piece of n. Light needs the whole scene, so the
 * filters give all of the result as piece 0. Other pieces have the same blocks and arrays without cells:
 * together the pieces have every cell once.
 */
bool isEmptyPieceRequested(vtkInformation* output);

/// Asks for all of an input, whatever piece the output is of.
void requestWhole(vtkInformation* input);

/// Polydata with the arrays of another, without points and cells.
vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* polyData);

/// Number of components that the irradiance has in polydata, or in the first leaf of a tree of them; else 1.
int bandsOf(vtkDataObject* data);

/// Adds an array of doubles without tuples.
void addEmptyArray(vtkDataSetAttributes* attributes, const char* name, int components);

}

#endif
