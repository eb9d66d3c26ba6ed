#include "OutputWriter.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace irradiance
{

namespace
{

vtkSmartPointer<vtkLinearTransform> toVtk(const AffineMap& map)
{
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(row, column, map.linear(row, column));
    }
    matrix->SetElement(row, 3, map.translation[row]);
  }
  auto transform = vtkSmartPointer<vtkMatrixToLinearTransform>::New();
  transform->SetInput(matrix);
  return transform;
}

void transformNormals(vtkLinearTransform* transform, vtkDataSetAttributes* attributes)
{
  if (vtkDataArray* normals = attributes->GetNormals())
  {
    auto moved = vtk::TakeSmartPointer(normals->NewInstance());
    moved->SetNumberOfComponents(3);
    moved->SetName(normals->GetName());
    transform->TransformNormals(normals, moved);
    attributes->SetNormals(moved);
  }
}

/// Model to world. The input's own arrays are not touched.
void movePoints(const AffineMap& worldFromObject, vtkPolyData* polyData)
{
  if (!polyData->GetPoints() || worldFromObject == AffineMap())
  {
    return;
  }
  const auto transform = toVtk(worldFromObject);
  vtkNew<vtkPoints> points;
  points->SetDataType(polyData->GetPoints()->GetDataType());
  transform->TransformPoints(polyData->GetPoints(), points);
  polyData->SetPoints(points);
  transformNormals(transform, polyData->GetPointData());
  transformNormals(transform, polyData->GetCellData());
}

template <class Array, class Value>
void addField(vtkMultiBlockDataSet* output, const char* name, std::initializer_list<Value> tuple)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  for (const Value value : tuple)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

void setBlock(
  vtkMultiBlockDataSet* parent, unsigned int index, vtkDataObject* block, const std::string& name)
{
  parent->SetBlock(index, block);
  parent->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

}

void OutputWriter::write(const std::vector<InputConnection>& fixed,
  const std::vector<InputConnection>& moving, vtkIdType numberOfWalks,
  vtkMultiBlockDataSet* output) const
{
  vtkNew<vtkMultiBlockDataSet> fixedBlocks, movingBlocks;
  setBlock(output, 0, fixedBlocks, "Static");
  setBlock(output, 1, movingBlocks, "Dynamic");
  for (unsigned int i = 0; i < fixed.size(); ++i)
  {
    vtkNew<vtkPolyData> polyData;
    polyData->ShallowCopy(fixed[i].polyData);
    addIrradiance(polyData, 0, scene_.firstCellOfFixed(i));
    setBlock(fixedBlocks, i, polyData, "Static " + std::to_string(i));
  }
  for (unsigned int i = 0; i < moving.size(); ++i)
  {
    vtkNew<vtkPolyData> polyData;
    polyData->ShallowCopy(moving[i].polyData);
    movePoints(scene_.objects().dynamic[i].worldFromObject, polyData);
    addIrradiance(polyData, i + 1, 0);
    setBlock(movingBlocks, i, polyData, "Dynamic " + std::to_string(i));
  }
  addFieldData(numberOfWalks, output);
}

void OutputWriter::addIrradiance(
  vtkPolyData* polyData, std::uint32_t object, std::size_t firstCell) const
{
  addArrays(polyData, "Irradiance", &IrradianceEngine::irradiance, object, firstCell);
  if (hasBudget_)
  {
    addArrays(polyData, "StaleIrradiance", &IrradianceEngine::staleIrradiance, object, firstCell);
  }
  if (!separateSides_)
  {
    polyData->GetCellData()->SetActiveScalars("Irradiance");
  }
}

void OutputWriter::addArrays(vtkPolyData* polyData, const std::string& name, Part part,
  std::uint32_t object, std::size_t firstCell) const
{
  addArray(polyData, separateSides_ ? name + "Front" : name, part, object, firstCell, 0);
  if (separateSides_)
  {
    addArray(polyData, name + "Back", part, object, firstCell, 1);
  }
}

void OutputWriter::addArray(vtkPolyData* polyData, const std::string& name, Part part,
  std::uint32_t object, std::size_t firstCell, int side) const
{
  const std::vector<double>& areas = scene_.areas(object);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(scene_.bands());
  array->SetNumberOfTuples(polyData->GetNumberOfCells());
  for (vtkIdType i = 0; i < polyData->GetNumberOfCells(); ++i)
  {
    const std::size_t cell = firstCell + static_cast<std::size_t>(i);
    for (int band = 0; band < scene_.bands(); ++band)
    {
      array->SetTypedComponent(i, band, (engine_.*part)(object, cell, side, band, areas[cell]));
    }
  }
  polyData->GetCellData()->AddArray(array);
}

void OutputWriter::addFieldData(vtkIdType numberOfWalks, vtkMultiBlockDataSet* output) const
{
  const auto addWatts = [&](const char* name, double first, double second, double third) {
    if (scene_.bands() == 1)
    {
      addField<vtkDoubleArray>(output, name, { first });
    }
    else
    {
      addField<vtkDoubleArray>(output, name, { first, second, third });
    }
  };
  const auto addPower = [&](const char* name, const Power& power) {
    addWatts(name, engine_.watts(power[0]), engine_.watts(power[1]), engine_.watts(power[2]));
  };
  const auto addCount = [&](const char* name, std::int64_t count) {
    addField<vtkIdTypeArray>(output, name, { static_cast<vtkIdType>(count) });
  };
  const auto addSeconds = [&](const char* name, double seconds) {
    addField<vtkDoubleArray>(output, name, { seconds });
  };
  const PowerBalance& balance = engine_.balance();
  const EngineStatistics& statistics = engine_.statistics();
  addPower("EmittedPower", balance.emitted);
  addPower("AbsorbedPower", balance.absorbed);
  addPower("EscapedPower", balance.escaped);
  addPower("StalePower", engine_.stale() ? engine_.stale()->power() : Power{});
  if (hasBudget_)
  {
    addWatts("StaleGainBound", engine_.staleGainBound(0), engine_.staleGainBound(1),
      engine_.staleGainBound(2));
  }
  addCount("NumberOfWalks", numberOfWalks);
  addCount("NumberOfSegments", balance.segments);
  addCount("NumberOfInvalidWalks", statistics.invalidWalks);
  addCount("NumberOfRepairedSegments", statistics.repairedSegments);
  addSeconds("ShootSeconds", statistics.shootSeconds);
  addSeconds("VerifySeconds", statistics.verifySeconds);
  addSeconds("RepairSeconds", statistics.repairSeconds);
  addCount("HistoryBytes", static_cast<std::int64_t>(statistics.historyBytes));
}

}
