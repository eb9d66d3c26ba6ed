// SPDX-License-Identifier: BSD-3-Clause
#include "Data/LeafData.h"

#include "Progress/InputError.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"

namespace irradiance
{

namespace
{

vtkDataSet* dataSetOf(const std::string& name, vtkDataObject* data)
{
  vtkDataSet* dataSet = vtkDataSet::SafeDownCast(data);
  throwIf(data && !dataSet, name, " of the input is a ", data ? data->GetClassName() : "",
    "; only data sets, which have cells, can be exposed");
  return dataSet;
}

}

std::string leafName(vtkDataObjectTreeIterator* leaf)
{
  std::string name = "block " + std::to_string(leaf->GetCurrentFlatIndex());
  if (leaf->HasCurrentMetaData() && leaf->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME()))
  {
    name += std::string(" (") + leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) + ")";
  }
  return name;
}

void forEachLeaf(vtkDataObjectTree* tree, const VisitLeaf& visit, bool withEmpty)
{
  const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
  leaves->VisitOnlyLeavesOn();
  leaves->SetSkipEmptyNodes(withEmpty ? 0 : 1);
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    visit(leaves);
  }
}

std::vector<LeafData> leavesOf(vtkDataObject* data)
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

vtkSmartPointer<vtkDataObject> snapshotOf(vtkDataObject* data)
{
  const std::vector<LeafData> leaves = leavesOf(data);
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  fillLeaves(data, copy,
    [&](std::size_t i) { return leaves[i].data ? shallowCopyOf(leaves[i].data) : nullptr; });
  return copy;
}

void copyLeaves(vtkDataObjectTree* tree, vtkDataObjectTree* copy)
{
  copy->ShallowCopy(tree);
  forEachLeaf(copy, [copy](vtkDataObjectTreeIterator* leaf) {
    copy->SetDataSet(leaf, shallowCopyOf(leaf->GetCurrentDataObject()));
  });
}

void fillLeaves(vtkDataObject* input, vtkDataObject* output, const MakeLeaf& make)
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

}
