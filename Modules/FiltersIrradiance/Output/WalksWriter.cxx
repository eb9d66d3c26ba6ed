// SPDX-License-Identifier: BSD-3-Clause
#include "Output/WalksWriter.h"

#include "Data/LeafData.h"
#include "Progress/InputError.h"
#include "Surfaces/SceneHash.h"
#include "Views/WalkPaths.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace irradiance
{

namespace
{

/// Walks as polydata, one after the other.
class Polylines
{
public:
  Polylines(int bands, bool withStale)
    : bands_(bands)
    , withStale_(withStale)
  {
    points_->SetDataTypeToDouble();
    powers_->SetNumberOfComponents(bands);
  }

  /// `before`: walks of groups before its own.
  void add(const WalkPath& path, const LightGroup& group, std::size_t before)
  {
    lines_->InsertNextCell(static_cast<int>(path.points.size()));
    for (std::size_t i = 0; i < path.points.size(); ++i)
    {
      lines_->InsertCellPoint(points_->InsertNextPoint(path.points[i].data()));
      bounces_->InsertNextValue(static_cast<int>(i));
      newPoints_->InsertNextValue(i >= path.firstRepaired ? 1 : 0);
    }
    walks_->InsertNextValue(static_cast<vtkIdType>(before + path.walk));
    repaired_->InsertNextValue(path.firstRepaired < path.points.size() ? 1 : 0);
    escaped_->InsertNextValue(path.escapes ? 1 : 0);
    stale_->InsertNextValue(path.isStale ? 1 : 0);
    for (int band = 0; band < bands_; ++band)
    {
      powers_->InsertNextValue(group.shown(group.engine->watts(path.power[band]), band));
    }
  }

  void moveTo(vtkPolyData* output)
  {
    output->SetPoints(points_);
    output->SetLines(lines_);
    vtkCellData* cells = output->GetCellData();
    addTo(cells, "WalkId", walks_);
    addTo(cells, "Power", powers_);
    addTo(cells, "Repaired", repaired_);
    addTo(cells, "Escaped", escaped_);
    if (withStale_)
    {
      addTo(cells, "Stale", stale_);
    }
    addTo(output->GetPointData(), "Bounce", bounces_);
    addTo(output->GetPointData(), "Repaired", newPoints_);
    cells->SetActiveScalars("Repaired");
  }

private:
  static void addTo(vtkFieldData* attributes, const char* name, vtkDataArray* array)
  {
    array->SetName(name);
    attributes->AddArray(array);
  }

  int bands_;
  bool withStale_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_;
  vtkNew<vtkIdTypeArray> walks_;
  vtkNew<vtkDoubleArray> powers_;
  vtkNew<vtkUnsignedCharArray> repaired_, escaped_, stale_, newPoints_;
  vtkNew<vtkIntArray> bounces_;
};

/// None if it is not there, as its part is away.
std::optional<SceneCell> cellOf(
  const WalksRequest& request, const PhotonSource& source, vtkMultiBlockDataSet* scene)
{
  std::optional<SceneCell> found;
  throwIf(request.port != 0 && request.port != 1, "the port of the cell is ", request.port,
    "; 0 (static) or 1 (dynamic) is possible");
  auto* connections =
    vtkMultiBlockDataSet::SafeDownCast(scene->GetBlock(static_cast<unsigned int>(request.port)));
  const int count = connections ? static_cast<int>(connections->GetNumberOfBlocks()) : 0;
  throwIf(request.connection < 0 || request.connection >= count, "the connection of the cell is ",
    request.connection, "; input port ", request.port, " has ", count,
    " connections, numbered from 0");
  const std::vector<LeafData> leaves =
    leavesOf(connections->GetBlock(static_cast<unsigned int>(request.connection)));
  vtkIdType first = 0;
  source.forEachPart(scene, [&](vtkPolyData* leaf, const PartCells& cells) {
    const auto isLeaf = [&](const LeafData& one) { return one.data == leaf; };
    if (std::none_of(leaves.begin(), leaves.end(), isLeaf))
    {
      return;
    }
    throwIf(cells.piece != nullptr, "the cell is ", request.cell,
      "; with DistributedInput the cells of an input have no common numbers; -1 means all walks");
    const vtkIdType cell = request.cell - first;
    if (cell >= 0 && cell < leaf->GetNumberOfCells())
    {
      found = cells[cell];
    }
    first += leaf->GetNumberOfCells();
  });
  // A part that is away has no cells.
  throwIf(request.cell < 0 || (!found && first > 0), "the cell is ", request.cell, "; ",
    request.port == 0 ? "static" : "dynamic", " connection ", request.connection, " has ", first,
    " cells, numbered from 0; -1 means all walks");
  return found;
}

}

std::uint64_t WalksRequest::hash() const
{
  Hash hash;
  hash.add(count, port, connection, cell);
  return hash.value();
}

void writeWalks(const WalksRequest& request, const PhotonSource& source,
  vtkMultiBlockDataSet* scene, Execution& execution, vtkPolyData* output)
{
  constexpr vtkIdType most = std::numeric_limits<std::uint32_t>::max();
  throwIf(request.count < 0 || request.count > most, "the number of walks is ", request.count,
    "; 0 to ", most, " are possible");
  const LightGroups& groups = *source.groups();
  const std::optional<SceneCell> cell =
    request.cell == -1 ? std::nullopt : cellOf(request, source, scene);
  Polylines polylines(source.bands(), groups.any().settings().repairTimeBudget > 0);
  auto left = static_cast<std::size_t>(request.count);
  std::size_t groupsLeft = groups.numberOfLit(), before = 0;
  groups.forEachLit([&](const LightGroup& group) {
    const WalkPaths paths(*group.engine);
    const std::size_t count = left / groupsLeft--;
    const std::vector<std::uint32_t> walks = request.cell == -1 ? paths.first(count)
      : cell ? paths.touching(*cell, count, execution)
             : std::vector<std::uint32_t>();
    left -= walks.size();
    constexpr std::size_t kTogether = 16384;
    for (std::size_t begin = 0; begin < walks.size(); begin += kTogether)
    {
      const auto from = walks.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto end =
        from + static_cast<std::ptrdiff_t>(std::min(kTogether, walks.size() - begin));
      for (const WalkPath& path : paths.paths({ from, end }, execution))
      {
        polylines.add(path, group, before);
      }
    }
    before += group.engine->walks().sets().back().plan().endWalk();
  });
  polylines.moveTo(output);
}

}
