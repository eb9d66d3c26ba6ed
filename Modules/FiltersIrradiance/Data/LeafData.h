// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LeafData_h
#define irradiance_LeafData_h

#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkDataSet;

namespace irradiance
{

/// A data set, or one block of composite data.
struct LeafData
{
  std::string name;       ///< for messages
  unsigned int flatIndex; ///< its place in the structure
  vtkDataSet* data;       ///< null: an empty block
};

/// As in "block 3 (Plate)".
std::string leafName(vtkDataObjectTreeIterator* leaf);

/// Calls visit(iterator) for all leaves of a tree, in order.
using VisitLeaf = std::function<void(vtkDataObjectTreeIterator*)>;
void forEachLeaf(vtkDataObjectTree* tree, const VisitLeaf& visit, bool withEmpty = false);

/// All leaves of data, in order, with the empty ones. Throws InputError if one is no vtkDataSet.
std::vector<LeafData> leavesOf(vtkDataObject* data);

/// A copy that shares the cells and arrays.
template <class Data>
vtkSmartPointer<Data> shallowCopyOf(Data* data)
{
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

/// A copy that shares the arrays, but neither leaves nor structure: it stays as it is when the
/// pipeline fills the original again.
vtkSmartPointer<vtkDataObject> snapshotOf(vtkDataObject* data);

/// Makes `copy` a tree with copies of the leaves of `tree` that share their cells and arrays.
void copyLeaves(vtkDataObjectTree* tree, vtkDataObjectTree* copy);

/// Fills `output` with the structure of `input` and, as the i-th leaf, what `make` returns for it.
using MakeLeaf = std::function<vtkSmartPointer<vtkDataSet>(std::size_t i)>;
void fillLeaves(vtkDataObject* input, vtkDataObject* output, const MakeLeaf& make);

}

#endif
