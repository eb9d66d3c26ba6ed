// SPDX-License-Identifier: BSD-3-Clause
#include "Output/WalksWriter.h"

#include "Progress/InputError.h"
#include "Surfaces/SceneHash.h"
#include "Views/WalkPaths.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <string>

namespace irradiance
{

namespace
{

[[noreturn]] void fail(const char* name, vtkIdType value, const std::string& possible)
{
  throw InputError(std::string(name) + " is " + std::to_string(value) + "; " + possible);
}

/// Walks as polydata, one after the other.
class Polylines
{
public:
  Polylines(const IrradianceEngine& engine, int bands, bool withStale)
    : engine_(engine)
    , bands_(bands)
    , withStale_(withStale)
  {
    points_->SetDataTypeToDouble();
    powers_->SetNumberOfComponents(bands);
  }

  void add(const WalkPath& path)
  {
    lines_->InsertNextCell(static_cast<int>(path.points.size()));
    for (std::size_t i = 0; i < path.points.size(); ++i)
    {
      lines_->InsertCellPoint(points_->InsertNextPoint(path.points[i].data()));
      bounces_->InsertNextValue(static_cast<int>(i));
      newPoints_->InsertNextValue(i >= path.firstRepaired ? 1 : 0);
    }
    walks_->InsertNextValue(static_cast<vtkIdType>(path.walk));
    repaired_->InsertNextValue(path.firstRepaired < path.points.size() ? 1 : 0);
    escaped_->InsertNextValue(path.escapes ? 1 : 0);
    stale_->InsertNextValue(path.isStale ? 1 : 0);
    for (int band = 0; band < bands_; ++band)
    {
      powers_->InsertNextValue(engine_.watts(path.power[band]));
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

  const IrradianceEngine& engine_;
  int bands_;
  bool withStale_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_;
  vtkNew<vtkIdTypeArray> walks_;
  vtkNew<vtkDoubleArray> powers_;
  vtkNew<vtkUnsignedCharArray> repaired_, escaped_, stale_, newPoints_;
  vtkNew<vtkIntArray> bounces_;
};

}

WalksWriter::WalksWriter(const WalksRequest& request, const std::vector<InputConnection>& statics,
  const std::vector<InputConnection>& dynamics)
  : request_(request)
{
  constexpr vtkIdType most = std::numeric_limits<std::uint32_t>::max();
  if (request.count < 0 || request.count > most)
  {
    fail("NumberOfOutputWalks", request.count, "0 to " + std::to_string(most) + " are possible");
  }
  if (isAsked() && request.cell != -1)
  {
    if (request.port != 0 && request.port != 1)
    {
      fail("OutputWalksPort", request.port, "0 (static) or 1 (dynamic) is possible");
    }
    findCell(request.port == 0 ? statics : dynamics);
  }
}

std::uint64_t WalksWriter::hash() const
{
  Hash hash;
  hash.add(request_.count);
  hash.add(request_.port);
  hash.add(request_.connection);
  hash.add(request_.cell);
  return hash.value();
}

void WalksWriter::findCell(const std::vector<InputConnection>& connections)
{
  const int count = static_cast<int>(connections.size());
  if (request_.connection < 0 || request_.connection >= count)
  {
    fail("OutputWalksConnection", request_.connection,
      "input port " + std::to_string(request_.port) + " has " + std::to_string(count) +
        " connections, numbered from 0");
  }
  std::size_t part = 0;
  for (int i = 0; i < request_.connection; ++i)
  {
    part += connections[static_cast<std::size_t>(i)].parts.size();
  }
  if (!connections.front().parts.empty() && connections.front().parts.front().cells)
  {
    fail("OutputWalksCell", request_.cell,
      "with DistributedInput the cells of an input have no common numbers; -1 means all walks");
  }
  const InputConnection& chosen = connections[static_cast<std::size_t>(request_.connection)];
  vtkIdType first = 0;
  for (const InputPart& leaf : chosen.parts)
  {
    const vtkIdType cell = request_.cell - first;
    if (cell >= 0 && cell < leaf.polyData->GetNumberOfCells())
    {
      cell_ = PartCell{ part, static_cast<std::size_t>(cell) };
    }
    first += leaf.polyData->GetNumberOfCells();
    ++part;
  }
  if (request_.cell < 0 || (!cell_ && first > 0)) // a part that is away has no cells
  {
    fail("OutputWalksCell", request_.cell,
      chosen.name + " has " + std::to_string(first) +
        " cells, numbered from 0; -1 means all walks");
  }
}

std::vector<std::uint32_t> WalksWriter::choose(
  const IrradianceEngine& engine, const SceneReader& scene, Execution& execution) const
{
  const WalkPaths paths(engine);
  const auto most = static_cast<std::size_t>(request_.count);
  if (request_.cell == -1)
  {
    return paths.first(most);
  }
  if (!cell_)
  {
    return {};
  }
  const SceneCell cell = request_.port == 0
    ? SceneCell{ 0, scene.firstCellOfStatic(cell_->part) + static_cast<std::size_t>(cell_->cell) }
    : SceneCell{ static_cast<std::uint32_t>(cell_->part + 1),
        static_cast<std::size_t>(cell_->cell) };
  return paths.touching(cell, most, execution);
}

void WalksWriter::write(const IrradianceEngine& engine, const SceneReader& scene, bool withStale,
  Execution& execution, vtkPolyData* output) const
{
  const std::vector<std::uint32_t> walks = choose(engine, scene, execution);
  constexpr std::size_t kTogether = 16384;
  const WalkPaths paths(engine);
  Polylines polylines(engine, scene.bands(), withStale);
  for (std::size_t begin = 0; begin < walks.size(); begin += kTogether)
  {
    const auto from = walks.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto count = static_cast<std::ptrdiff_t>(std::min(kTogether, walks.size() - begin));
    for (const WalkPath& path : paths.paths({ from, from + count }, execution))
    {
      polylines.add(path);
    }
  }
  polylines.moveTo(output);
}

}
