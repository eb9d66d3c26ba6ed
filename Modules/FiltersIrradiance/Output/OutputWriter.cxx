// SPDX-License-Identifier: BSD-3-Clause
#include "Output/OutputWriter.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Data/NamedArray.h"
#include "Input/Pose.h"
#include "Output/EmptyPiece.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkLinearTransform.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

namespace
{

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
  const auto transform = transformOf(matrixOf(worldFromObject).data());
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

using MakePart = std::function<vtkSmartPointer<vtkPolyData>(const InputPart&)>;

/// The output of a connection, in the structure of its input.
vtkSmartPointer<vtkDataObject> blockOf(const InputConnection& connection, const MakePart& makePart)
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

void writeBlocks(const SceneInputs& inputs, const MakePart& makePart, vtkMultiBlockDataSet* output)
{
  vtkNew<vtkMultiBlockDataSet> staticBlocks, dynamicBlocks;
  setBlock(output, 0, staticBlocks, "Static");
  setBlock(output, 1, dynamicBlocks, "Dynamic");
  for (unsigned int i = 0; i < inputs.statics.size(); ++i)
  {
    setBlock(staticBlocks, i, blockOf(inputs.statics[i], makePart),
      nameOf(inputs.statics[i].data, "Static", i));
  }
  for (unsigned int i = 0; i < inputs.dynamics.size(); ++i)
  {
    const auto block = blockOf(inputs.dynamics[i], makePart);
    block->GetFieldData()->RemoveArray(kFieldPoseName);
    setBlock(dynamicBlocks, i, block, nameOf(inputs.dynamics[i].data, "Dynamic", i));
  }
}

struct OutputWriter
{
  const LightGroups& groups;
  const SceneReader& scene;
  const OutputArrays& arrays;
  const CancelPoint& cancelPoint;
  const IrradianceEngine& any = groups.any();
  const EngineSettings& settings = any.settings();
  LightGroupErrors errors{ groups };

  void write(const SceneInputs& inputs, vtkMultiBlockDataSet* output) const
  {
    std::size_t number = 0;
    const auto makePart = [&](const InputPart& part) {
      const SceneCell first = scene.firstCellOf(number++);
      auto polyData = vtkSmartPointer<vtkPolyData>::New();
      polyData->ShallowCopy(part.piece);
      if (first.object > 0)
      {
        movePoints(part.worldFromPart, polyData);
        polyData->GetFieldData()->RemoveArray(kFieldPoseName); // applied
        if (part.innerPose)
        {
          polyData->GetFieldData()->RemoveArray(part.innerPose);
        }
      }
      addIrradiance(polyData, { first, part.cells });
      return polyData;
    };
    writeBlocks(inputs, makePart, output);
    addFieldData(output->GetFieldData());
  }

  void addIrradiance(vtkPolyData* polyData, const PartCells& cells) const
  {
    int side = settings.separateSides ? 0 : CellSide::kBoth;
    for (const char* suffix : suffixesOf(settings))
    {
      addSide(polyData, suffix, cells, side++);
    }
    activateIrradiance(polyData, settings);
  }

  /// `suffix`: part of the arrays' names, such as Front.
  void addSide(
    vtkPolyData* polyData, const std::string& suffix, const PartCells& cells, int side) const
  {
    const int bands = scene.bands();
    const auto add = [&](const std::string& name, int components, const auto& value) {
      const auto array = addArray<vtkDoubleArray>(
        polyData->GetCellData(), name, components, polyData->GetNumberOfCells());
      ThrottledCancelPoint pace(cancelPoint);
      for (vtkIdType i = 0; i < polyData->GetNumberOfCells(); ++i)
      {
        pace.step(static_cast<std::size_t>(components));
        const CellSide cell{ cells[i], side };
        for (int component = 0; component < components; ++component)
        {
          array->SetTypedComponent(i, component, value(cell, component));
        }
      }
    };
    const std::string name = irradianceName(suffix);
    add(name, bands, [&](const CellSide& cell, int band) { return groups.irradiance(cell, band); });
    if (arrays.errors)
    {
      add(standardErrorName(name), bands, [&](const CellSide& cell, int band) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        return hasArea(cell) ? errors.standardError(cell, band) : unknown;
      });
    }
    if (arrays.replicates)
    {
      add(photonName(suffix), bands, [&](const CellSide& cell, int band) {
        return hasArea(cell) ? errors.ofPhoton(cell, band) : 0;
      });
    }
    if (arrays.replicates && arrays.errors)
    {
      const std::uint32_t replicates = any.walks().plan().replicates().count();
      add(replicatesName(suffix), static_cast<int>(replicates) * bands,
        [&](const CellSide& cell, int part) {
          const auto replicate = static_cast<std::uint32_t>(part / bands);
          return hasArea(cell) ? errors.ofReplicate(cell, part % bands, replicate) : 0;
        });
    }
    if (settings.repairTimeBudget > 0)
    {
      add(staleName(suffix), bands, [&](const CellSide& cell, int band) {
        return groups.sum(
          band, [&](const IrradianceEngine& engine) { return engine.staleIrradiance(cell, band); });
      });
    }
    if (arrays.groups)
    {
      addSideOfGroups(name, add);
    }
  }

  /// Likewise of each group alone. `add`: adds an array.
  template <class Add>
  void addSideOfGroups(const std::string& name, const Add& add) const
  {
    const int bands = scene.bands();
    for (const LightGroup& group : groups.all())
    {
      const std::string ofGroup = nameOfGroup(name, group.name);
      add(ofGroup, bands, [&](const CellSide& cell, int band) {
        return group.engine ? group.shown(group.engine->irradiance(cell, band), band) : 0;
      });
      if (arrays.errors)
      {
        add(standardErrorName(ofGroup), bands, [&](const CellSide& cell, int band) {
          return hasArea(cell) ? errors.standardErrorOf(group.name, cell, band) : 0;
        });
      }
    }
  }

  bool hasArea(const CellSide& cell) const { return any.cells().area(cell) > 0; }

  void addFieldData(vtkFieldData* fields) const
  {
    const auto addWatts = [&](const std::string& name, const auto& wattsOf) {
      std::vector<double> watts;
      for (int band = 0; band < scene.bands(); ++band)
      {
        watts.push_back(wattsOf(band));
      }
      addTuple<vtkDoubleArray>(fields, name, watts);
    };
    const auto powerOf = [&](int band, Power PowerBalance::*power) {
      return groups.sum(band, [&](const IrradianceEngine& engine) {
        return engine.watts((engine.balance().*power)[band]);
      });
    };
    // The integers balance; so that the rounded watts do too, they are added.
    addWatts(kEmittedPower, [&](int band) {
      return powerOf(band, &PowerBalance::absorbed) + powerOf(band, &PowerBalance::escaped);
    });
    addWatts(kAbsorbedPower, [&](int band) { return powerOf(band, &PowerBalance::absorbed); });
    addWatts(kEscapedPower, [&](int band) { return powerOf(band, &PowerBalance::escaped); });
    for (const char* name : { kAbsorbedPower, kEscapedPower })
    {
      addWatts(standardErrorName(name), [&](int band) {
        return groups.sumOfErrors(
          band, [&](const IrradianceEngine& engine) { return engine.escapedError(band); });
      });
    }
    addWatts(kStalePower, [&](int band) {
      return groups.sum(band,
        [&](const IrradianceEngine& engine) { return engine.watts(engine.stalePower()[band]); });
    });
    if (settings.repairTimeBudget > 0)
    {
      addWatts("StaleGainBound", [&](int band) {
        return groups.sum(
          band, [&](const IrradianceEngine& engine) { return engine.staleGainBound(band); });
      });
    }
    addGroups(fields);
    addStatistics(fields);
  }

  void addStatistics(vtkFieldData* fields) const
  {
    const auto addCount = [&](const char* name, std::int64_t count) {
      addTuple<vtkIdTypeArray>(fields, name, { static_cast<vtkIdType>(count) });
    };
    const auto addNumber = [&](const char* name, double number) {
      addTuple<vtkDoubleArray>(fields, name, { number });
    };
    using Engine = IrradianceEngine;
    const WalkStatistics statistics =
      groups.count([](const Engine& engine) -> WalkStatistics { return engine.statistics(); });
    addCount(kNumberOfWalks,
      groups.count([](const Engine& engine) { return engine.walks().numberOfShotWalks(); }));
    addCount("NumberOfSegments",
      groups.count([](const Engine& engine) { return engine.balance().segments; }));
    if (settings.cellEstimate == CellEstimate::Gathered)
    {
      addCount("NumberOfGatherRays", static_cast<std::int64_t>(any.numberOfGatherRays()));
    }
    addCount("DirectLight", settings.gathersDirectLight ? 1 : 0);
    addCount("CellEstimate", static_cast<int>(settings.cellEstimate));
    if (arrays.errors)
    {
      addNumber("ConfidenceFactor", ErrorEstimate::confidenceFactor(settings.replicates));
    }
    if (settings.targetRelativeError > 0)
    {
      addNumber("ReachedRelativeError", groups.reachedRelativeError());
    }
    addCount("NumberOfInvalidWalks", statistics.invalidWalks);
    addCount("NumberOfRepairedSegments", statistics.repairedSegments);
    addNumber("ShootSeconds", statistics.shootSeconds);
    addNumber("VerifySeconds", statistics.verifySeconds);
    addNumber("RepairSeconds", statistics.repairSeconds);
    addCount("HistoryBytes", groups.count([](const Engine& engine) {
      return static_cast<std::int64_t>(engine.statistics().historyBytes);
    }));
  }

  /// The names of groups and their factors.
  void addGroups(vtkFieldData* fields) const
  {
    const auto count = static_cast<vtkIdType>(groups.all().size());
    if (!arrays.groups)
    {
      return;
    }
    const auto names = addArray<vtkStringArray>(fields, "LightGroups", 1, count);
    const auto factors =
      addArray<vtkDoubleArray>(fields, "LightGroupFactors", scene.bands(), count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const LightGroup& group = groups.all()[static_cast<std::size_t>(i)];
      names->SetValue(i, group.name);
      std::copy_n(group.factor.data(), scene.bands(), factors->GetPointer(i * scene.bands()));
    }
  }
};

}

void writeOutput(const LightGroups& groups, const SceneReader& scene, const SceneInputs& inputs,
  const OutputArrays& arrays, const CancelPoint& cancelPoint, vtkMultiBlockDataSet* output)
{
  OutputWriter{ groups, scene, arrays, cancelPoint }.write(inputs, output);
}

void writeEmptyOutput(const SceneInputs& inputs, const EngineSettings& settings, bool withErrors,
  vtkMultiBlockDataSet* output)
{
  const int bands = SceneReader::countBands(inputs);
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
  writeBlocks(inputs, makePart, output);
}

}
