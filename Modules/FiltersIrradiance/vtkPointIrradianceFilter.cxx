// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointIrradianceFilter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "FinalGather/CellRoles.h"
#include "Input/PointFacets.h"
#include "Output/EmptyPiece.h"
#include "Output/LightArrays.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/WalkMemory.h"
#include "Views/GroupSensors.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

using namespace irradiance;

vtkStandardNewMacro(vtkPointIrradianceFilter);

class vtkPointIrradianceFilter::vtkInternals
{
public:
  GroupSensors Stored;
  irradiance::OldNames OldNames;
};

namespace
{

/// Of a polydata of the scene.
struct Surface
{
  vtkPolyData* output;
  std::vector<PointFacet> facets;
};

/// One for each side of each facet to which light can come, the front before the back.
std::vector<Sensor> SensorsOf(const std::vector<Surface>& surfaces)
{
  std::vector<Sensor> sensors;
  for (const Surface& surface : surfaces)
  {
    for (const PointFacet& facet : surface.facets)
    {
      if (!facet.isFrontDark)
      {
        sensors.push_back(facet.front);
      }
      if (!facet.isBackDark)
      {
        sensors.push_back({ facet.front.position, -facet.front.normal });
      }
    }
  }
  return sensors;
}

/// The arrays of a surface: one, or one for each side.
std::vector<LightArrays> AddArrays(
  vtkPolyData* output, int bands, bool haveErrors, bool areSidesApart)
{
  vtkPointData* points = output->GetPointData();
  const auto add = [&](const char* suffix) {
    return LightArrays(
      points, pointIrradianceName(suffix), bands, output->GetNumberOfPoints(), haveErrors);
  };
  if (areSidesApart)
  {
    return { add("Front"), add("Back") };
  }
  std::vector<LightArrays> arrays{ add("") };
  points->SetActiveScalars(pointIrradianceName().c_str());
  return arrays;
}

/// Sides are dark to which no group brings light.
CellShapes DarkShapesOf(const LightGroups& groups, const CancelPoint& cancelPoint)
{
  std::optional<CellShapes> all;
  groups.forEachLit([&](const LightGroup& group) {
    CellShapes shapes = darkShapesOf(group.engine->walks(), group.engine->frame(), cancelPoint);
    for (std::size_t cell = 0; all && cell < shapes.size(); ++cell)
    {
      all->setDark(cell, (*all)[cell].isFrontDark && shapes[cell].isFrontDark,
        (*all)[cell].isBackDark && shapes[cell].isBackDark);
    }
    if (!all)
    {
      all = std::move(shapes);
    }
  });
  return *all;
}

/// Without cells, see isEmptyPieceRequested().
void WriteEmptyPoints(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  emptyLeaves(input, output, [input](vtkPolyData* empty) {
    const bool areSidesApart = empty->GetCellData()->HasArray(irradianceName("Front").c_str()) != 0;
    AddArrays(empty, bandsOf(empty), haveErrors(input), areSidesApart);
  });
}

using Received = SensorFinalGather::Replicates;

/// Gives the points of a surface the light that their facets received. `dark`: where nothing comes.
/// `next`: what sensors received, in their order; returns what is next after those of the surface.
const Received* WritePoints(const Surface& surface, const std::vector<LightArrays>& arrays,
  const Received& dark, const Received* next)
{
  SensorFinalGather::Light unknown{};
  unknown.value.fill(std::numeric_limits<double>::quiet_NaN());
  unknown.standardError = unknown.value;
  for (const LightArrays& side : arrays)
  {
    for (vtkIdType i = 0; i < surface.output->GetNumberOfPoints(); ++i)
    {
      side.set(i, unknown);
    }
  }
  const auto addNext = [&next](bool isDark, double weight, Received& mean) {
    for (std::size_t k = 0; !isDark && k < mean.size(); ++k)
    {
      mean[k] += weight * (*next)[k];
    }
    next += isDark ? 0 : 1;
  };
  const std::vector<PointFacet>& facets = surface.facets;
  for (std::size_t first = 0, end = 0; first < facets.size(); first = end)
  {
    double angle = 0;
    for (; end < facets.size() && facets[end].point == facets[first].point; ++end)
    {
      angle += facets[end].angle;
    }
    std::vector<Received> means(arrays.size(), dark);
    for (std::size_t i = first; i < end; ++i)
    {
      const double weight = facets[i].angle / angle;
      addNext(facets[i].isFrontDark, weight, means.front());
      addNext(facets[i].isBackDark, weight, means.back());
    }
    for (std::size_t side = 0; side < arrays.size(); ++side)
    {
      arrays[side].set(facets[first].point, SensorFinalGather::lightOf(means[side]));
    }
  }
  return next;
}

}

vtkPointIrradianceFilter::vtkPointIrradianceFilter()
  : Internals(new vtkInternals)
{
}

vtkPointIrradianceFilter::~vtkPointIrradianceFilter() = default;

int vtkPointIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  return setInputTypes(info, "vtkMultiBlockDataSet", "vtkDataObject");
}

void vtkPointIrradianceFilter::Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  const PhotonSource source(input, "the input", false);
  const LightGroups& groups = *source.groups();
  const IrradianceEngine& engine = groups.any();
  SmpExecution execution = executionOf(this);
  const CancelPoint reading = cancelPointOf(execution, 0);
  copyLeaves(input, output);
  const double rounding = sensorClearance(boundsBesideLamps(engine.objects()));
  const CellShapes shapes = DarkShapesOf(groups, reading);
  std::vector<Surface> surfaces;
  source.forEachPart(output, [&](vtkPolyData* polyData, const PartCells& cells) {
    surfaces.push_back({ polyData,
      pointFacetsOf(polyData, engine.objects()[cells.first.object].isMirrored(),
        vtkMath::RadiansFromDegrees(this->FeatureAngle), rounding, cells, shapes, reading) });
  });
  GroupSensors& stored = this->Internals->Stored;
  const std::vector<Sensor> sensors = SensorsOf(surfaces);
  const auto rays = static_cast<std::uint32_t>(this->NumberOfRays);
  stored.update(groups, sensors, rays, mayKeepRays(sensors.size(), rays), execution);
  const Received dark(engine.walks().plan().replicates().count());
  const Received* next = stored.replicates().data();
  for (const Surface& surface : surfaces)
  {
    next = WritePoints(surface,
      AddArrays(surface.output, source.bands(), haveErrors(input), engine.settings().separateSides),
      dark, next);
  }
}

int vtkPointIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return runFilter(this, output, [&] {
    PhotonSource::isEmptyPiece(input, outputs->GetInformationObject(0))
      ? WriteEmptyPoints(input, output)
      : this->Compute(input, output);
  });
}

void vtkPointIrradianceFilter::SetKeepRays(bool)
{
  this->Internals->OldNames.warn(this, "KeepRays", "rays are kept where there is memory for them");
}

void vtkPointIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n"
     << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
}
