// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointIrradianceFilter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Input/PointFacets.h"
#include "Output/EmptyPiece.h"
#include "Output/LightArrays.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonRequest.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/PieceRequest.h"
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
};

namespace
{

/// Of a polydata of the scene.
struct Surface
{
  vtkPolyData* output;
  std::vector<irradiance::PointFacet> facets;
};

/// One for the front of each facet, and behind it one for its back.
std::vector<irradiance::Sensor> SensorsOf(const std::vector<Surface>& surfaces)
{
  std::vector<irradiance::Sensor> sensors;
  for (const Surface& surface : surfaces)
  {
    for (const irradiance::PointFacet& facet : surface.facets)
    {
      sensors.push_back(facet.front);
      sensors.push_back({ facet.front.position, -facet.front.normal });
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
void WriteEmpty(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  output->ShallowCopy(input);
  irradiance::emptyLeaves(output, [input](vtkPolyData* empty) {
    const bool areSidesApart =
      empty->GetCellData()->HasArray(irradiance::irradianceName("Front").c_str()) != 0;
    AddArrays(empty, irradiance::bandsOf(empty), irradiance::haveErrors(input), areSidesApart);
  });
}

/// Gives points the light that their facets received.
class PointWriter
{
public:
  using Replicates = irradiance::SensorGather::Replicates;

  /// `received`: by the sensors, from the first of the surface on.
  PointWriter(const Surface& surface, const Replicates* received,
    const std::vector<irradiance::LightArrays>& arrays)
    : Facets(surface.facets)
    , Received(received)
    , Arrays(arrays)
  {
    const irradiance::SensorGather::Light unknown =
      LightOf(std::numeric_limits<double>::quiet_NaN());
    for (const irradiance::LightArrays& side : arrays)
    {
      for (vtkIdType i = 0; i < surface.output->GetNumberOfPoints(); ++i)
      {
        side.set(i, unknown);
      }
    }
  }

  void Write() const
  {
    for (std::size_t first = 0, end = 0; first < this->Facets.size(); first = end)
    {
      while (end < this->Facets.size() && this->Facets[end].point == this->Facets[first].point)
      {
        ++end;
      }
      for (std::size_t side = 0; side < this->Arrays.size(); ++side)
      {
        this->Arrays[side].set(this->Facets[first].point,
          irradiance::SensorGather::lightOf(this->MeanOf(first, end, side)));
      }
    }
  }

private:
  static irradiance::SensorGather::Light LightOf(double value)
  {
    irradiance::SensorGather::Light light{};
    light.value.fill(value);
    light.standardError.fill(value);
    return light;
  }

  /// Of some facets, on one side, or on both together.
  Replicates MeanOf(std::size_t first, std::size_t end, std::size_t side) const
  {
    double angle = 0;
    for (std::size_t i = first; i < end; ++i)
    {
      angle += this->Facets[i].angle;
    }
    Replicates mean(this->Received[2 * first].size());
    const std::size_t sides = this->Arrays.size() > 1 ? 1 : 2;
    for (std::size_t i = 2 * first; i < 2 * end; ++i)
    {
      if (sides == 2 || i % 2 == side)
      {
        Add(this->Received[i], this->Facets[i / 2].angle / angle, mean);
      }
    }
    return mean;
  }
  static void Add(const Replicates& received, double weight, Replicates& sum)
  {
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      for (std::size_t band = 0; band < sum[k].size(); ++band)
      {
        sum[k][band] += weight * received[k][band];
      }
    }
  }

  const std::vector<irradiance::PointFacet>& Facets;
  const Replicates* Received;
  const std::vector<irradiance::LightArrays>& Arrays;
};

}

vtkPointIrradianceFilter::vtkPointIrradianceFilter()
  : Internals(new vtkInternals)
{
}

vtkPointIrradianceFilter::~vtkPointIrradianceFilter() = default;

int vtkPointIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  // Any other type is refused by PhotonSource, in words that help.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkPointIrradianceFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  irradiance::requestSides(inputs[0]->GetInformationObject(0));
  return 1;
}

void vtkPointIrradianceFilter::Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output)
{
  const irradiance::PhotonSource source(input, "the input", irradiance::PhotonSource::Need::Sides);
  const irradiance::IrradianceEngine& engine = *source.engine();
  irradiance::SmpExecution execution = irradiance::executionOf(this);
  const irradiance::CancelPoint reading = irradiance::cancelPointOf(execution, 0);
  output->ShallowCopy(input);
  irradiance::cloneLeaves(output);
  const double rounding = 0x1p-20 * engine.scene().bounds().magnitude();
  std::vector<Surface> surfaces;
  source.forEachPart(output, [&](vtkPolyData* polyData, const irradiance::PartCells&) {
    surfaces.push_back({ polyData,
      irradiance::pointFacetsOf(
        polyData, vtkMath::RadiansFromDegrees(this->FeatureAngle), rounding, reading) });
  });
  irradiance::StoredSensors& stored = this->Internals->Stored;
  stored.update(source.engine(), SensorsOf(surfaces),
    static_cast<std::uint32_t>(this->NumberOfRays), this->KeepRays, execution);
  const irradiance::SensorGather::Replicates* received = stored.replicates().data();
  for (const Surface& surface : surfaces)
  {
    const std::vector<irradiance::LightArrays> arrays =
      AddArrays(surface.output, engine.objects().staticObject.material->bands,
        irradiance::haveErrors(input), engine.settings().separateSides);
    PointWriter(surface, received, arrays).Write();
    received += 2 * surface.facets.size();
  }
}

int vtkPointIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return irradiance::runFilter(this, output, [&] {
    // What could not be computed has no blocks: that is an error on all processes.
    if (input && input->GetNumberOfBlocks() > 0 && !irradiance::PhotonSource::isIn(input) &&
      irradiance::isEmptyPieceRequested(outputs->GetInformationObject(0)))
    {
      WriteEmpty(input, output);
      return;
    }
    this->Compute(input, output);
  });
}

void vtkPointIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n"
     << indent << "FeatureAngle: " << this->FeatureAngle << "\n"
     << indent << "KeepRays: " << this->KeepRays << "\n";
}
