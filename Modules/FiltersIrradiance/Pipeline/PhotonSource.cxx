// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/PhotonSource.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Pipeline/PieceRequest.h"
#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObject.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <utility>

namespace irradiance
{

namespace
{

/// What information can hold.
class EngineReference : public vtkObject
{
public:
  vtkTypeMacro(EngineReference, vtkObject);
  static EngineReference* New();

  std::shared_ptr<IrradianceEngine> engine;
  std::uint64_t state = 0;
  std::vector<PieceCells> pieces;
};
vtkStandardNewMacro(EngineReference);

vtkInformationObjectBaseKey* engineKey()
{
  static auto* const key = new vtkInformationObjectBaseKey("PHOTONS", "vtkIrradianceFilter");
  return key;
}

/// Copies of data share its arrays, but not its own information: so an array holds the reference.
constexpr const char* kHolder = kNumberOfWalks;

EngineReference* referenceIn(vtkDataObject* data)
{
  vtkAbstractArray* holder =
    data && data->GetFieldData() ? data->GetFieldData()->GetAbstractArray(kHolder) : nullptr;
  return holder && holder->HasInformation() ? static_cast<EngineReference*>(vtkObject::SafeDownCast(
                                                holder->GetInformation()->Get(engineKey())))
                                            : nullptr;
}

/// Calls visit(polydata, or null for other data) for the leaves of a block, in order.
template <class Visit>
void forEachPolyData(vtkDataObject* block, const Visit& visit)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(block))
  {
    forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
      visit(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
    });
  }
}

}

void PhotonSource::attach(vtkMultiBlockDataSet* output, std::shared_ptr<IrradianceEngine> engine,
  std::vector<PieceCells> pieces)
{
  vtkNew<EngineReference> reference;
  reference->pieces = std::move(pieces);
  reference->state = engine->state();
  reference->engine = std::move(engine);
  output->GetFieldData()->GetAbstractArray(kHolder)->GetInformation()->Set(engineKey(), reference);
}

bool PhotonSource::isEmptyPiece(vtkMultiBlockDataSet* data, vtkInformation* output)
{
  return data && data->GetNumberOfBlocks() > 0 && !referenceIn(data) &&
    isEmptyPieceRequested(output);
}

void PhotonSource::fillInputPort(vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
}

PhotonSource::PhotonSource(vtkDataObject* data, const char* what, Need need)
  : what_(what)
{
  EngineReference* reference = referenceIn(data);
  if (!reference)
  {
    throw InputError(std::string(what) +
      " is no output of vtkIrradianceFilter, or has lost its photons (files do not keep them): "
      "connect the filter, or a shallow copy of its whole output");
  }
  engine_ = reference->engine;
  pieces_ = reference->pieces;
  if (!engine_->isValid() || engine_->state() != reference->state)
  {
    throw InputError(std::string(what) +
      " is out of date: its vtkIrradianceFilter has executed since. Take its new output");
  }
  if (need == Need::Photons && !engine_->storesWalks())
  {
    throw InputError(std::string(what) +
      " was computed without keeping the photons, as nothing can move: connect the "
      "vtkIrradianceFilter itself, which then keeps them");
  }
}

void PhotonSource::failUnlike() const
{
  throw InputError(std::string(what_) +
    " is a part of an output of vtkIrradianceFilter, or has other cells: the whole output is "
    "needed");
}

void PhotonSource::checkCells(
  vtkPolyData* polyData, std::size_t part, std::size_t cellsOfPart) const
{
  const PieceCells piece = part < pieces_.size() ? pieces_[part] : nullptr;
  if (part >= pieces_.size() || !polyData ||
    static_cast<std::size_t>(polyData->GetNumberOfCells()) != (piece ? piece->size() : cellsOfPart))
  {
    failUnlike();
  }
}

void PhotonSource::forEachPart(vtkMultiBlockDataSet* data, const Visit& visit) const
{
  const SceneObjects& objects = engine_->objects();
  if (data->GetNumberOfBlocks() != 2)
  {
    failUnlike();
  }
  const Material& statics = *objects.staticObject.material;
  std::size_t part = 0;
  forEachPolyData(data->GetBlock(0), [&](vtkPolyData* polyData) {
    if (part >= statics.firstCellOfPart.size())
    {
      failUnlike();
    }
    const std::size_t first = statics.firstCellOfPart[part];
    const bool isLast = part + 1 == statics.firstCellOfPart.size();
    checkCells(
      polyData, part, (isLast ? statics.numberOfCells : statics.firstCellOfPart[part + 1]) - first);
    visit(polyData, { { 0, first }, pieces_[part] });
    ++part;
  });
  if (part != statics.firstCellOfPart.size())
  {
    failUnlike();
  }
  std::uint32_t object = 0;
  forEachPolyData(data->GetBlock(1), [&](vtkPolyData* polyData) {
    ++object;
    if (object >= objects.size())
    {
      failUnlike();
    }
    checkCells(
      polyData, part, objects[object].isPresent ? objects[object].material->numberOfCells : 0);
    visit(polyData, { { object, 0 }, pieces_[part] });
    ++part;
  });
  if (object + 1 != objects.size())
  {
    failUnlike();
  }
}

}
