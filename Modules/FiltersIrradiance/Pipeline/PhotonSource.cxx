// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/PhotonSource.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Pipeline/UpstreamRequest.h"
#include "Progress/InputError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <utility>

namespace irradiance
{

namespace
{

/// What information can hold.
class GroupsReference : public vtkObject
{
public:
  vtkTypeMacro(GroupsReference, vtkObject);
  static GroupsReference* New();

  std::shared_ptr<LightGroups> groups;
  std::uint64_t state = 0;
  std::vector<PieceCells> pieces;
};
vtkStandardNewMacro(GroupsReference);

vtkInformationObjectBaseKey* groupsKey()
{
  static auto* const key = new vtkInformationObjectBaseKey("PHOTONS", "vtkIrradianceFilter");
  return key;
}

/// Copies of data share its arrays, but not its own information: so an array holds the reference.
constexpr const char* kHolder = kNumberOfWalks;

GroupsReference* referenceIn(vtkDataObject* data)
{
  vtkAbstractArray* holder =
    data && data->GetFieldData() ? data->GetFieldData()->GetAbstractArray(kHolder) : nullptr;
  return holder && holder->HasInformation() ? static_cast<GroupsReference*>(vtkObject::SafeDownCast(
                                                holder->GetInformation()->Get(groupsKey())))
                                            : nullptr;
}

/// Of the leaves of a block, in order; null for other data.
std::vector<vtkPolyData*> polyDataOf(vtkDataObject* block)
{
  std::vector<vtkPolyData*> all;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(block))
  {
    forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
      all.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
    });
  }
  return all;
}

}

void PhotonSource::attach(
  vtkMultiBlockDataSet* output, std::shared_ptr<LightGroups> groups, std::vector<PieceCells> pieces)
{
  vtkNew<GroupsReference> reference;
  reference->pieces = std::move(pieces);
  reference->state = groups->state();
  reference->groups = std::move(groups);
  output->GetFieldData()->GetAbstractArray(kHolder)->GetInformation()->Set(groupsKey(), reference);
}

bool PhotonSource::isEmptyPiece(vtkMultiBlockDataSet* data, vtkInformation* output)
{
  return data && data->GetNumberOfBlocks() > 0 && !referenceIn(data) &&
    isEmptyPieceRequested(output);
}

PhotonSource::PhotonSource(vtkDataObject* data, const char* what, bool readsPhotons)
  : what_(what)
{
  GroupsReference* reference = referenceIn(data);
  throwIf(!reference, what,
    " is no output of vtkIrradianceFilter, or has lost its photons (files do not keep them): "
    "connect the filter, or a shallow copy of its whole output");
  groups_ = reference->groups;
  pieces_ = reference->pieces;
  throwIf(!groups_->isValid() || groups_->state() != reference->state, what,
    " is out of date: its vtkIrradianceFilter has executed since. Take its new output");
  throwIf(readsPhotons && !groups_->any().storesWalks(), what,
    " was computed without keeping the photons, as nothing can move: connect the "
    "vtkIrradianceFilter itself, which then keeps them");
}

void PhotonSource::forEachPart(vtkMultiBlockDataSet* data, const Visit& visit) const
{
  const auto check = [&](bool isAlike) {
    throwIf(!isAlike, what_,
      " is a part of an output of vtkIrradianceFilter, or has other cells: the whole output is "
      "needed");
  };
  check(data->GetNumberOfBlocks() == 2);
  std::vector<vtkPolyData*> parts = polyDataOf(data->GetBlock(0));
  const std::vector<vtkPolyData*> dynamics = polyDataOf(data->GetBlock(1));
  const SceneObjects& objects = groups_->any().objects();
  const Material& material = *objects.staticObject.material;
  std::vector<std::size_t> ends = material.firstCellOfPart; // of the static parts
  check(parts.size() == ends.size() && dynamics.size() + 1 == objects.size());
  parts.insert(parts.end(), dynamics.begin(), dynamics.end());
  check(parts.size() == pieces_.size());
  ends.push_back(material.numberOfCells);
  const std::size_t statics = ends.size() - 1;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const bool isStatic = i < statics;
    const SceneCell first{ isStatic ? 0 : static_cast<std::uint32_t>(i - statics + 1),
      isStatic ? ends[i] : 0 };
    const SceneObject& object = objects[first.object];
    const std::size_t whole = isStatic ? ends[i + 1] - ends[i]
      : object.isPresent               ? object.material->numberOfCells
                                       : 0;
    check(parts[i] &&
      static_cast<std::size_t>(parts[i]->GetNumberOfCells()) ==
        (pieces_[i] ? pieces_[i]->size() : whole));
    visit(parts[i], { first, pieces_[i] });
  }
}

}
