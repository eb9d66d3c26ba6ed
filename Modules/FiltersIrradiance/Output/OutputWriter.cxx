// SPDX-License-Identifier: BSD-3-Clause
#include "Output/OutputWriter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Data/NamedArray.h"
#include "Input/Pose.h"
#include "Output/EmptyPiece.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <limits>

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

/// Moves points and active normals to the world. Integer points become double, as integers cannot
/// hold the result. The input's own arrays do not change.
void movePoints(const AffineMap& worldFromObject, vtkPolyData* polyData)
{
  vtkPoints* model = polyData->GetPoints();
  const bool isFloating =
    model && (model->GetDataType() == VTK_FLOAT || model->GetDataType() == VTK_DOUBLE);
  if (!model || (isFloating && worldFromObject == AffineMap()))
  {
    return;
  }
  const auto transform = toVtk(worldFromObject);
  vtkNew<vtkPoints> points;
  points->SetDataType(isFloating ? model->GetDataType() : VTK_DOUBLE);
  transform->TransformPoints(model, points);
  polyData->SetPoints(points);
  transformNormals(transform, polyData->GetPointData());
  transformNormals(transform, polyData->GetCellData());
}

/// An empty block of a type that a vtkMultiBlockDataSet may hold: it refuses partitioned ones.
vtkSmartPointer<vtkDataObjectTree> emptyBlock(vtkDataObjectTree* input)
{
  if (input->IsA("vtkPartitionedDataSet"))
  {
    return vtkSmartPointer<vtkMultiPieceDataSet>::New();
  }
  return vtkSmartPointer<vtkMultiBlockDataSet>::New();
}

/// Of the names of arrays, for both sides together or for each.
using Suffixes = std::vector<const char*>;
const Suffixes& suffixesOf(const EngineSettings& settings)
{
  static const Suffixes sides{ "Front", "Back" }, together{ "" };
  return settings.separateSides ? sides : together;
}

void activateIrradiance(vtkPolyData* polyData, const EngineSettings& settings)
{
  if (!settings.separateSides)
  {
    polyData->GetCellData()->SetActiveScalars(irradianceName().c_str());
  }
}

/// What the input says of itself by a field array; else its port and number.
std::string nameOf(vtkDataObject* data, const char* port, unsigned int connection)
{
  auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("Name"));
  const bool isNamed = names && names->GetNumberOfValues() > 0 && !names->GetValue(0).empty();
  return isNamed ? std::string(names->GetValue(0))
                 : std::string(port) + " " + std::to_string(connection);
}

void setBlock(
  vtkMultiBlockDataSet* parent, unsigned int index, vtkDataObject* block, const std::string& name)
{
  parent->SetBlock(index, block);
  parent->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

}

vtkSmartPointer<vtkDataObject> OutputWriter::blockOf(
  const InputConnection& connection, const MakePart& makePart)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(connection.data);
  if (!tree)
  {
    return makePart(connection.parts.front());
  }
  const auto block = emptyBlock(tree);
  block->CopyStructure(tree);
  block->GetFieldData()->PassData(tree->GetFieldData());
  auto part = connection.parts.begin();
  forEachLeaf(
    tree, [&](vtkDataObjectTreeIterator* leaf) { block->SetDataSet(leaf, makePart(*part++)); });
  return block;
}

void OutputWriter::writeBlocks(const std::vector<InputConnection>& statics,
  const std::vector<InputConnection>& dynamics, const MakePart& makeStatic,
  const MakePart& makeDynamic, vtkMultiBlockDataSet* output)
{
  vtkNew<vtkMultiBlockDataSet> staticBlocks, dynamicBlocks;
  setBlock(output, 0, staticBlocks, "Static");
  setBlock(output, 1, dynamicBlocks, "Dynamic");
  for (unsigned int i = 0; i < statics.size(); ++i)
  {
    setBlock(
      staticBlocks, i, blockOf(statics[i], makeStatic), nameOf(statics[i].data, "Static", i));
  }
  for (unsigned int i = 0; i < dynamics.size(); ++i)
  {
    const auto block = blockOf(dynamics[i], makeDynamic);
    block->GetFieldData()->RemoveArray(kFieldPoseName);
    setBlock(dynamicBlocks, i, block, nameOf(dynamics[i].data, "Dynamic", i));
  }
}

void OutputWriter::write(const std::vector<InputConnection>& statics,
  const std::vector<InputConnection>& dynamics, vtkMultiBlockDataSet* output) const
{
  std::size_t staticPart = 0;
  const auto makeStatic = [&](const InputPart& part) {
    auto polyData = vtkSmartPointer<vtkPolyData>::New();
    polyData->ShallowCopy(part.piece);
    addIrradiance(polyData, { { 0, scene_.firstCellOfStatic(staticPart++) }, part.cells });
    return polyData;
  };
  std::uint32_t object = 0;
  const auto makeDynamic = [&](const InputPart& part) {
    auto polyData = vtkSmartPointer<vtkPolyData>::New();
    polyData->ShallowCopy(part.piece);
    movePoints(part.worldFromPart, polyData);
    polyData->GetFieldData()->RemoveArray(kFieldPoseName); // applied
    if (part.innerPose)
    {
      polyData->GetFieldData()->RemoveArray(part.innerPose);
    }
    addIrradiance(polyData, { { ++object, 0 }, part.cells });
    return polyData;
  };
  writeBlocks(statics, dynamics, makeStatic, makeDynamic, output);
  addFieldData(output);
}

void OutputWriter::writeEmpty(const std::vector<InputConnection>& statics,
  const std::vector<InputConnection>& dynamics, const EngineSettings& settings, bool withErrors,
  vtkMultiBlockDataSet* output)
{
  const int bands = SceneReader::countBands(statics, dynamics);
  const auto makePart = [&](const InputPart& part) {
    auto polyData = withoutCells(part.polyData);
    const auto add = [&](const std::string& name) {
      addArray<vtkDoubleArray>(polyData->GetCellData(), name, bands, 0);
    };
    for (const char* suffix : suffixesOf(settings))
    {
      add(irradianceName(suffix));
      if (withErrors)
      {
        add(standardErrorName(irradianceName(suffix)));
      }
      if (settings.repairTimeBudget > 0)
      {
        add(staleName(suffix));
      }
    }
    activateIrradiance(polyData, settings);
    return polyData;
  };
  writeBlocks(statics, dynamics, makePart, makePart, output);
}

void OutputWriter::addIrradiance(vtkPolyData* polyData, const PartCells& cells) const
{
  int side = settings_.separateSides ? 0 : CellSide::kBoth;
  for (const char* suffix : suffixesOf(settings_))
  {
    addSide(polyData, suffix, cells, side++);
  }
  activateIrradiance(polyData, settings_);
}

void OutputWriter::addSide(
  vtkPolyData* polyData, const std::string& suffix, const PartCells& cells, int side) const
{
  const auto add = [&](const std::string& name, const auto& value) {
    const auto array = addArray<vtkDoubleArray>(
      polyData->GetCellData(), name, scene_.bands(), polyData->GetNumberOfCells());
    ThrottledCancelPoint pace(cancelPoint_);
    for (vtkIdType i = 0; i < polyData->GetNumberOfCells(); ++i)
    {
      pace.step();
      const CellSide cell{ cells[i], side };
      for (int band = 0; band < scene_.bands(); ++band)
      {
        array->SetTypedComponent(i, band, value(cell, band));
      }
    }
  };
  add(irradianceName(suffix),
    [&](const CellSide& cell, int band) { return engine_.irradiance(cell, band); });
  if (withErrors_)
  {
    add(standardErrorName(irradianceName(suffix)),
      [&](const CellSide& cell, int band) { return standardError(cell, band); });
  }
  if (withReplicates_)
  {
    add(photonName(suffix), [&](const CellSide& cell, int band) {
      const double area = engine_.cells().area(cell);
      return area > 0 ? engine_.watts(errors_.quantaPerPhoton(cell, band)) / area : 0.0;
    });
  }
  if (withReplicates_ && withErrors_)
  {
    addReplicates(polyData, suffix, cells, side);
  }
  if (settings_.repairTimeBudget > 0)
  {
    add(staleName(suffix),
      [&](const CellSide& cell, int band) { return engine_.staleIrradiance(cell, band); });
  }
}

void OutputWriter::addReplicates(
  vtkPolyData* polyData, const std::string& suffix, const PartCells& cells, int side) const
{
  const int bands = scene_.bands();
  const auto replicates = static_cast<int>(errors_.replicates());
  const auto parts = addArray<vtkDoubleArray>(polyData->GetCellData(), replicatesName(suffix),
    replicates * bands, polyData->GetNumberOfCells());
  ThrottledCancelPoint pace(cancelPoint_);
  for (vtkIdType i = 0; i < polyData->GetNumberOfCells(); ++i)
  {
    const CellSide cell{ cells[i], side };
    const double area = engine_.cells().area(cell);
    for (int part = 0; part < replicates * bands; ++part)
    {
      pace.step();
      const double quanta =
        errors_.ofReplicate(cell, part % bands, static_cast<std::uint32_t>(part / bands));
      parts->SetTypedComponent(i, part, area > 0 ? engine_.watts(quanta) / area : 0.0);
    }
  }
}

double OutputWriter::standardError(const CellSide& cell, int band) const
{
  const double area = engine_.cells().area(cell);
  return area > 0 ? engine_.watts(errors_.standardError(cell, band)) / area
                  : std::numeric_limits<double>::quiet_NaN();
}

void OutputWriter::addFieldData(vtkMultiBlockDataSet* output) const
{
  vtkFieldData* fields = output->GetFieldData();
  const auto addWatts = [&](const char* name, double first, double second, double third) {
    std::vector<double> watts{ first, second, third };
    watts.resize(static_cast<std::size_t>(scene_.bands()));
    addTuple<vtkDoubleArray>(fields, name, watts);
  };
  const auto addPower = [&](const char* name, const Power& power) {
    addWatts(name, engine_.watts(power[0]), engine_.watts(power[1]), engine_.watts(power[2]));
  };
  const PowerBalance& balance = engine_.balance();
  // The integers balance; so that the rounded watts do too, they are added.
  const auto emitted = [&](int band) {
    return engine_.watts(balance.absorbed[band]) + engine_.watts(balance.escaped[band]);
  };
  addWatts(kEmittedPower, emitted(0), emitted(1), emitted(2));
  addPower(kAbsorbedPower, balance.absorbed);
  addPower(kEscapedPower, balance.escaped);
  for (const char* name : { kAbsorbedPower, kEscapedPower })
  {
    addWatts(standardErrorName(name).c_str(), engine_.escapedError(0), engine_.escapedError(1),
      engine_.escapedError(2));
  }
  addPower(kStalePower, engine_.stalePower());
  if (settings_.repairTimeBudget > 0)
  {
    addWatts(kStaleGainBound, engine_.staleGainBound(0), engine_.staleGainBound(1),
      engine_.staleGainBound(2));
  }
  addStatistics(fields);
}

void OutputWriter::addStatistics(vtkFieldData* fields) const
{
  const auto addCount = [&](const char* name, std::int64_t count) {
    addTuple<vtkIdTypeArray>(fields, name, { static_cast<vtkIdType>(count) });
  };
  const auto addNumber = [&](const char* name, double number) {
    addTuple<vtkDoubleArray>(fields, name, { number });
  };
  const EngineStatistics& statistics = engine_.statistics();
  addCount(kNumberOfWalks, engine_.walks().numberOfShotWalks());
  addCount(kNumberOfSegments, engine_.balance().segments);
  if (settings_.cellEstimate == CellEstimate::Gathered)
  {
    addCount(kNumberOfGatherRays, static_cast<std::int64_t>(engine_.numberOfGatherRays()));
  }
  addCount(kDirectLight, settings_.gathersDirectLight ? 1 : 0);
  addCount(kCellEstimate, static_cast<int>(settings_.cellEstimate));
  if (withErrors_)
  {
    addNumber(kConfidenceFactor, ErrorEstimate::confidenceFactor(settings_.replicates));
  }
  if (settings_.targetRelativeError > 0)
  {
    addNumber(kReachedRelativeError, engine_.reachedRelativeError());
  }
  addCount(kNumberOfInvalidWalks, statistics.invalidWalks);
  addCount(kNumberOfRepairedSegments, statistics.repairedSegments);
  addNumber(kShootSeconds, statistics.shootSeconds);
  addNumber(kVerifySeconds, statistics.verifySeconds);
  addNumber(kRepairSeconds, statistics.repairSeconds);
  addCount(kHistoryBytes, static_cast<std::int64_t>(statistics.historyBytes));
}

}
