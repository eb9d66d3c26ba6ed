// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointIrradianceFilter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Data/OldNames.h"
#include "FinalGather/CellRoles.h"
#include "Input/PointFacets.h"
#include "Output/EmptyPiece.h"
#include "Output/LightArrays.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/WalkMemory.h"
#include "Views/StoredSensors.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>
#include <vector>

vtkStandardNewMacro(vtkPointIrradianceFilter);

class vtkPointIrradianceFilter::vtkInternals
{
public:
  irradiance::StoredSensors Stored;
  irradiance::OldNames OldNames;
};

namespace
{

/// Of a polydata of the scene.
struct Surface
{
  vtkPolyData* output;
  std::vector<irradiance::PointFacet> facets;
};

/// One for each side of each facet to which light can come, the front before the back.
std::vector<irradiance::Sensor> SensorsOf(const std::vector<Surface>& surfaces)
{
  std::vector<irradiance::Sensor> sensors;
  for (const Surface& surface : surfaces)
  {
    for (const irradiance::PointFacet& facet : surface.facets)
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
std::vector<irradiance::LightArrays> AddArrays(
  vtkPolyData* output, int bands, bool haveErrors, bool areSidesApart)
{
  vtkPointData* points = output->GetPointData();
  const auto add = [&](const char* suffix) {
    return irradiance::LightArrays(points, irradiance::pointIrradianceName(suffix), bands,
      output->GetNumberOfPoints(), haveErrors);
  };
  if (areSidesApart)
  {
    return { add("Front"), add("Back") };
  }
  std::vector<irradiance::LightArrays> arrays{ add("") };
  points->SetActiveScalars(irradiance::pointIrradianceName().c_str());
  return arrays;
}

/// Without cells, see PieceRequest.h.
void WriteEmptyPoints(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  output->ShallowCopy(input);
  irradiance::emptyLeaves(output, [input](vtkPolyData* empty) {
    const bool areSidesApart =
      empty->GetCellData()->HasArray(irradiance::irradianceName("Front").c_str()) != 0;
    AddArrays(empty, irradiance::bandsOf(empty), irradiance::haveErrors(input), areSidesApart);
  });
}

using Replicates = irradiance::SensorFinalGather::Replicates;

void Add(const Replicates& received, double weight, Replicates& sum)
{
  for (std::size_t k = 0; k < sum.size(); ++k)
  {
    for (std::size_t band = 0; band < sum[k].size(); ++band)
    {
      sum[k][band] += weight * received[k][band];
    }
  }
}

/// Gives points the light that their facets received: takes what is next, in the order of the
/// sensors.
class PointWriter
{
public:
  /// `replicates`: their number.
  PointWriter(const std::vector<Replicates>& received, std::size_t replicates)
    : Next(received.data())
    , Dark(replicates)
  {
  }

  void Write(const Surface& surface, const std::vector<irradiance::LightArrays>& arrays)
  {
    this->WriteUnknown(surface.output->GetNumberOfPoints(), arrays);
    const std::vector<irradiance::PointFacet>& facets = surface.facets;
    for (std::size_t first = 0, end = 0; first < facets.size(); first = end)
    {
      double angle = 0;
      for (; end < facets.size() && facets[end].point == facets[first].point; ++end)
      {
        angle += facets[end].angle;
      }
      std::vector<Replicates> means(arrays.size(), this->Dark);
      for (std::size_t i = first; i < end; ++i)
      {
        const double weight = facets[i].angle / angle;
        this->AddNext(facets[i].isFrontDark, weight, means.front());
        this->AddNext(facets[i].isBackDark, weight, means.back());
      }
      for (std::size_t side = 0; side < arrays.size(); ++side)
      {
        arrays[side].set(facets[first].point, irradiance::SensorFinalGather::lightOf(means[side]));
      }
    }
  }

private:
  static void WriteUnknown(vtkIdType points, const std::vector<irradiance::LightArrays>& arrays)
  {
    irradiance::SensorFinalGather::Light unknown{};
    unknown.value.fill(std::numeric_limits<double>::quiet_NaN());
    unknown.standardError = unknown.value;
    for (const irradiance::LightArrays& side : arrays)
    {
      for (vtkIdType i = 0; i < points; ++i)
      {
        side.set(i, unknown);
      }
    }
  }
  void AddNext(bool isDark, double weight, Replicates& mean)
  {
    if (!isDark)
    {
      Add(*this->Next++, weight, mean);
    }
  }

  const Replicates* Next;
  Replicates Dark; ///< what nothing comes to
};

}

vtkPointIrradianceFilter::vtkPointIrradianceFilter()
  : Internals(new vtkInternals)
{
}

vtkPointIrradianceFilter::~vtkPointIrradianceFilter() = default;

int vtkPointIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  irradiance::PhotonSource::fillInputPort(info);
  return 1;
}

void vtkPointIrradianceFilter::Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  const irradiance::PhotonSource source(input, "the input", irradiance::PhotonSource::Need::Sums);
  const irradiance::IrradianceEngine& engine = *source.engine();
  irradiance::SmpExecution execution = irradiance::executionOf(this);
  const irradiance::CancelPoint reading = irradiance::cancelPointOf(execution, 0);
  output->ShallowCopy(input);
  irradiance::cloneLeaves(output);
  const double rounding =
    irradiance::sensorClearance(irradiance::boundsBesideLamps(engine.objects()));
  const irradiance::CellShapes shapes =
    irradiance::darkShapesOf(engine.walks(), engine.frame(), reading);
  std::vector<Surface> surfaces;
  source.forEachPart(output, [&](vtkPolyData* polyData, const irradiance::PartCells& cells) {
    surfaces.push_back({ polyData,
      irradiance::pointFacetsOf(polyData, engine.objects()[cells.first.object].isMirrored(),
        vtkMath::RadiansFromDegrees(this->FeatureAngle), rounding, cells, shapes, reading) });
  });
  irradiance::StoredSensors& stored = this->Internals->Stored;
  const std::vector<irradiance::Sensor> sensors = SensorsOf(surfaces);
  const auto rays = static_cast<std::uint32_t>(this->NumberOfRays);
  stored.update(
    source.engine(), sensors, rays, irradiance::mayKeepRays(sensors.size(), rays), execution);
  PointWriter writer(stored.replicates(), engine.walks().plan().replicates().count());
  for (const Surface& surface : surfaces)
  {
    writer.Write(surface,
      AddArrays(surface.output, engine.objects().staticObject.material->bands,
        irradiance::haveErrors(input), engine.settings().separateSides));
  }
}

int vtkPointIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return irradiance::runFilter(this, output, [&] {
    irradiance::PhotonSource::isEmptyPiece(input, outputs->GetInformationObject(0))
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
