// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOutgoingRadianceFilter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Execution/Execution.h"
#include "Output/EmptyPiece.h"
#include "Output/LightArrays.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Progress/InputError.h"
#include "Views/OutgoingRadiance.h"

#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

using namespace irradiance;

vtkStandardNewMacro(vtkOutgoingRadianceFilter);

/// What does not depend on the eye is kept while the camera moves.
class vtkOutgoingRadianceFilter::vtkInternals
{
public:
  using Light = OutgoingRadiance::Light;

  /// Needed before at().
  void Prepare(const std::shared_ptr<LightGroups>& groups, int samples, Execution& execution)
  {
    if (this->Groups == groups && this->State == groups->state() && this->Samples == samples)
    {
      return;
    }
    this->Radiances.clear();
    this->Groups.reset(); // until all is prepared
    groups->forEachLit([&](const LightGroup& group) {
      this->Radiances.emplace_back(group,
        std::make_unique<OutgoingRadiance>(
          *group.engine, static_cast<std::uint32_t>(samples), execution));
    });
    this->Groups = groups;
    this->State = groups->state();
    this->Samples = samples;
  }

  /// Of all groups. May be called by several threads.
  std::vector<Light> At(const std::vector<SceneCell>& cells, const Eye& eye) const
  {
    std::vector<Light> sums(cells.size());
    for (const auto& [group, radiance] : this->Radiances)
    {
      const std::vector<Light> lights = radiance->at(cells, eye);
      for (std::size_t i = 0; i < sums.size(); ++i)
      {
        for (int band = 0; band < Power::kMaxBands; ++band)
        {
          const auto at = static_cast<std::size_t>(band);
          double& error = sums[i].standardError[at];
          sums[i].value[at] += group.shown(lights[i].value[at], band);
          error = std::hypot(error, group.shown(lights[i].standardError[at], band));
        }
      }
    }
    return sums;
  }

private:
  std::vector<std::pair<LightGroup, std::unique_ptr<OutgoingRadiance>>> Radiances;
  std::shared_ptr<LightGroups> Groups;
  std::uint64_t State = 0;
  int Samples = 0;
};

namespace
{

Eye EyeOf(vtkOutgoingRadianceFilter* filter)
{
  Eye eye;
  filter->GetEyePosition(eye.position.data());
  if (vtkCamera* camera = filter->GetCamera())
  {
    eye.isFar = camera->GetParallelProjection() != 0;
    eye.isFar ? camera->GetDirectionOfProjection(eye.position.data())
              : camera->GetPosition(eye.position.data());
    eye.position = eye.isFar ? Vector3(-eye.position) : eye.position;
  }
  throwIf(!eye.position.allFinite(), "the eye is at (", eye.position[0], ", ", eye.position[1],
    ", ", eye.position[2], "), which is not finite");
  return eye;
}

/// Adds the arrays of a part.
LightArrays AddArrays(vtkPolyData* output, int bands, bool haveErrors)
{
  vtkCellData* cells = output->GetCellData();
  const LightArrays arrays(cells, kRadiance, bands, output->GetNumberOfCells(), haveErrors);
  cells->SetActiveScalars(kRadiance);
  return arrays;
}

/// Without cells, see isEmptyPieceRequested().
void WriteEmpty(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  emptyLeaves(input, output,
    [input](vtkPolyData* empty) { AddArrays(empty, bandsOf(empty), haveErrors(input)); });
}

/// Some cells of a part.
struct Unit
{
  LightArrays arrays;
  PartCells cells;
  vtkIdType begin, end; ///< of the part
};

/// `size`: cells of each.
std::vector<Unit> MakeUnits(
  const PhotonSource& source, vtkIdType size, bool haveErrors, vtkMultiBlockDataSet* output)
{
  const int bands = source.bands();
  std::vector<Unit> units;
  source.forEachPart(output, [&](vtkPolyData* polyData, const PartCells& cells) {
    const LightArrays arrays = AddArrays(polyData, bands, haveErrors);
    for (vtkIdType begin = 0; begin < polyData->GetNumberOfCells(); begin += size)
    {
      units.push_back(
        { arrays, cells, begin, std::min(begin + size, polyData->GetNumberOfCells()) });
    }
  });
  return units;
}

}

vtkOutgoingRadianceFilter::vtkOutgoingRadianceFilter()
  : Internals(new vtkInternals)
{
}

vtkOutgoingRadianceFilter::~vtkOutgoingRadianceFilter() = default;

vtkCxxSetSmartPointerMacro(vtkOutgoingRadianceFilter, Camera, vtkCamera);

vtkCamera* vtkOutgoingRadianceFilter::GetCamera()
{
  return this->Camera;
}

vtkMTimeType vtkOutgoingRadianceFilter::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Camera ? std::max(own, this->Camera->GetMTime()) : own;
}

int vtkOutgoingRadianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  return setInputTypes(info, "vtkMultiBlockDataSet", "vtkDataObject");
}

void vtkOutgoingRadianceFilter::Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  const Eye eye = EyeOf(this);
  const PhotonSource source(input, "the input", false);
  SmpExecution execution = executionOf(this);
  this->Internals->Prepare(source.groups(), this->NumberOfSpecularSamples, execution);
  copyLeaves(input, output);
  constexpr int raysTogether = 4096;
  const vtkIdType cellsTogether = std::max(1, raysTogether / this->NumberOfSpecularSamples);
  const std::vector<Unit> units = MakeUnits(source, cellsTogether, haveErrors(input), output);
  forEachSliced(units.size(), execution, [&](std::size_t i) {
    const Unit& unit = units[i];
    std::vector<SceneCell> cells;
    for (vtkIdType cell = unit.begin; cell < unit.end; ++cell)
    {
      cells.push_back(unit.cells[cell]);
    }
    vtkIdType cell = unit.begin;
    for (const OutgoingRadiance::Light& light : this->Internals->At(cells, eye))
    {
      unit.arrays.set(cell++, light);
    }
  });
}

int vtkOutgoingRadianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return runFilter(this, output, [&] {
    PhotonSource::isEmptyPiece(input, outputs->GetInformationObject(0))
      ? WriteEmpty(input, output)
      : this->Compute(input, output);
  });
}

void vtkOutgoingRadianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyePosition: " << this->EyePosition[0] << " " << this->EyePosition[1] << " "
     << this->EyePosition[2] << "\n"
     << indent << "NumberOfSpecularSamples: " << this->NumberOfSpecularSamples << "\n"
     << indent << "Camera: " << this->Camera.Get() << "\n";
}
