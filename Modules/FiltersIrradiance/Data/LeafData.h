// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Progress/InputError.h"

#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

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
inline std::string leafName(vtkDataObjectTreeIterator* leaf)
{
  std::string name = "block " + std::to_string(leaf->GetCurrentFlatIndex());
  if (leaf->HasCurrentMetaData() && leaf->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME()))
  {
    name += std::string(" (") + leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) + ")";
  }
  return name;
}

/// Calls visit(iterator) for all leaves of a tree, in order.
using VisitLeaf = std::function<void(vtkDataObjectTreeIterator*)>;
inline void forEachLeaf(vtkDataObjectTree* tree, const VisitLeaf& visit, bool withEmpty = false)
{
  const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
  leaves->VisitOnlyLeavesOn();
  leaves->SetSkipEmptyNodes(withEmpty ? 0 : 1);
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    visit(leaves);
  }
}

/// Null for null. Throws InputError for data without cells.
inline vtkDataSet* dataSetOf(const std::string& name, vtkDataObject* data)
{
  vtkDataSet* dataSet = vtkDataSet::SafeDownCast(data);
  throwIf(data && !dataSet, name, " of the input is a ", data ? data->GetClassName() : "",
    "; only data sets, which have cells, can be exposed");
  return dataSet;
}

/// All leaves of data, in order, with the empty ones. Throws InputError if one is no vtkDataSet.
inline std::vector<LeafData> leavesOf(vtkDataObject* data)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(data);
  if (!tree)
  {
    return { { "the input", 0, dataSetOf("all", data) } };
  }
  std::vector<LeafData> leaves;
  const auto add = [&](vtkDataObjectTreeIterator* leaf) {
    const std::string name = leafName(leaf);
    leaves.push_back(
      { name, leaf->GetCurrentFlatIndex(), dataSetOf(name, leaf->GetCurrentDataObject()) });
  };
  forEachLeaf(tree, add, true);
  return leaves;
}

/// A copy that shares the cells and arrays.
template <class Data>
vtkSmartPointer<Data> shallowCopyOf(Data* data)
{
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

/// Makes `copy` a tree with copies of the leaves of `tree` that share their cells and arrays.
inline void copyLeaves(vtkDataObjectTree* tree, vtkDataObjectTree* copy)
{
  copy->ShallowCopy(tree);
  forEachLeaf(copy, [copy](vtkDataObjectTreeIterator* leaf) {
    copy->SetDataSet(leaf, shallowCopyOf(leaf->GetCurrentDataObject()));
  });
}

/// Fills `output` with the structure of `input` and, as the i-th leaf, what `make` returns for it.
using MakeLeaf = std::function<vtkSmartPointer<vtkDataSet>(std::size_t i)>;
inline void fillLeaves(vtkDataObject* input, vtkDataObject* output, const MakeLeaf& make)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    if (const auto leaf = make(0))
    {
      output->ShallowCopy(leaf);
    }
    return;
  }
  auto* filled = vtkDataObjectTree::SafeDownCast(output);
  filled->CopyStructure(tree);
  filled->GetFieldData()->PassData(tree->GetFieldData());
  std::size_t i = 0;
  const auto fill = [&](vtkDataObjectTreeIterator* place) {
    if (const auto leaf = make(i++))
    {
      filled->SetDataSet(place, leaf);
    }
  };
  forEachLeaf(tree, fill, true);
}

/// A copy that shares the arrays, but neither leaves nor structure: it stays as it is when the
/// pipeline fills the original again.
inline vtkSmartPointer<vtkDataObject> snapshotOf(vtkDataObject* data)
{
  const std::vector<LeafData> leaves = leavesOf(data);
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  fillLeaves(data, copy,
    [&](std::size_t i) { return leaves[i].data ? shallowCopyOf(leaves[i].data) : nullptr; });
  return copy;
}

}
