// SPDX-License-Identifier: BSD-3-Clause
#include "CureTable.h"

#include <vtkCellCenters.h>
#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

namespace curingoven
{
namespace
{

void Add(Cure& row, double area, double dose, double halfWidth, const OvenOptions& options)
{
  // An interval that is not known holds everything.
  const auto isOpen = [&](double limit) { return !(std::abs(dose - limit) > halfWidth); };
  row.Area += area;
  row.MeanDose += area * dose; // a mean when all are added
  row.LeastDose = std::min(row.LeastDose, dose);
  row.MostDose = std::max(row.MostDose, dose);
  row.UnderArea += dose < options.LeastDose ? area : 0;
  row.OverArea += dose > options.MostDose ? area : 0;
  row.OpenArea += isOpen(options.LeastDose) || isOpen(options.MostDose) ? area : 0;
}

Cure JudgePart(
  vtkPolyData* part, const std::string& name, double factor, const OvenOptions& options)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(part);
  sizes->Update();
  vtkDataArray* areas = sizes->GetPolyDataOutput()->GetCellData()->GetArray("Area");
  vtkDataArray* doses = part->GetCellData()->GetArray("RadiantExposure");
  vtkDataArray* errors = part->GetCellData()->GetArray("RadiantExposureStandardError");
  vtkNew<vtkDoubleArray> halfWidths;
  halfWidths->SetName("HalfWidth");
  vtkNew<vtkIntArray> cures;
  cures->SetName("Cure");
  Cure row;
  row.Name = name;
  row.LeastDose = std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < part->GetNumberOfCells(); ++i)
  {
    const double dose = doses->GetTuple1(i);
    const double halfWidth = factor * errors->GetTuple1(i);
    halfWidths->InsertNextValue(halfWidth);
    cures->InsertNextValue(dose < options.LeastDose ? -1 : dose > options.MostDose ? 1 : 0);
    Add(row, areas->GetTuple1(i), dose, halfWidth, options);
  }
  row.MeanDose /= row.Area;
  part->GetCellData()->AddArray(areas);
  part->GetCellData()->AddArray(halfWidths);
  part->GetCellData()->AddArray(cures);
  return row;
}

Cure SumOf(const std::vector<Cure>& rows)
{
  Cure sum = rows.front();
  sum.Name = "all";
  sum.MeanDose *= sum.Area;
  for (auto row = rows.begin() + 1; row != rows.end(); ++row)
  {
    sum.Area += row->Area;
    sum.MeanDose += row->Area * row->MeanDose;
    sum.LeastDose = std::min(sum.LeastDose, row->LeastDose);
    sum.MostDose = std::max(sum.MostDose, row->MostDose);
    sum.UnderArea += row->UnderArea;
    sum.OverArea += row->OverArea;
    sum.OpenArea += row->OpenArea;
  }
  sum.MeanDose /= sum.Area;
  return sum;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File Open(const std::string& name)
{
  File file(std::fopen(name.c_str(), "w"), std::fclose);
  if (!file)
  {
    throw std::runtime_error("--output: " + name + " cannot be written");
  }
  return file;
}

}

std::vector<vtkPolyData*> PartsOf(vtkMultiBlockDataSet* scene)
{
  auto* dynamic = vtkMultiBlockDataSet::SafeDownCast(scene->GetBlock(1));
  return vtkCompositeDataSet::GetDataSets<vtkPolyData>(dynamic);
}

std::vector<Cure> Judge(
  vtkMultiBlockDataSet* scene, const std::vector<Part>& parts, const OvenOptions& options)
{
  const double factor = scene->GetFieldData()->GetArray("ConfidenceFactor")->GetTuple1(0);
  const std::vector<vtkPolyData*> meshes = PartsOf(scene);
  std::vector<Cure> rows;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    rows.push_back(JudgePart(meshes[i], parts[i].Name, factor, options));
  }
  rows.push_back(SumOf(rows));
  return rows;
}

double ReachedAccuracy(vtkMultiBlockDataSet* scene, const OvenOptions& options)
{
  std::vector<std::pair<double, double>> areas; // with the relative half-width of each
  double left = 0;
  for (vtkPolyData* part : PartsOf(scene))
  {
    vtkCellData* cells = part->GetCellData();
    for (vtkIdType i = 0; i < part->GetNumberOfCells(); ++i)
    {
      const double dose = cells->GetArray("RadiantExposure")->GetTuple1(i);
      const double width =
        cells->GetArray("HalfWidth")->GetTuple1(i) / std::max(dose, options.LeastDose);
      const double area = cells->GetArray("Area")->GetTuple1(i);
      areas.emplace_back(std::isnan(width) ? std::numeric_limits<double>::infinity() : width, area);
      left += 0.95 * area;
    }
  }
  std::sort(areas.begin(), areas.end());
  double reached = 0;
  for (auto cell = areas.begin(); cell != areas.end() && left > 0; ++cell)
  {
    reached = cell->first;
    left -= cell->second;
  }
  return reached;
}

void PrintTable(const std::vector<Cure>& rows, const OvenOptions& options)
{
  std::printf("\n%-14s %9s %27s %10s %10s %10s\n%-14s %9s %9s %8s %8s %10s %10s %10s\n", "", "area",
    "dose (kJ/m2)", "under", "over", "undecided", "part", "cm2", "mean", "least", "most", "cured",
    "cured", "");
  for (const Cure& row : rows)
  {
    const double percent = 100 / row.Area;
    std::printf("%-14.14s %9.1f %9.2f %8.2f %8.2f %8.1f %% %8.1f %% %8.1f %%\n", row.Name.c_str(),
      1e4 * row.Area, row.MeanDose / 1e3, row.LeastDose / 1e3, row.MostDose / 1e3,
      percent * row.UnderArea, percent * row.OverArea, percent * row.OpenArea);
  }
  std::printf(
    "Shares of the area below %g and above %g kJ/m2; undecided: a limit lies within the 95 %%\n"
    "interval of the cell's dose, or too few photons arrived to know that interval.\n\n",
    options.LeastDose / 1e3, options.MostDose / 1e3);
}

void WriteTables(const std::vector<Cure>& rows, vtkMultiBlockDataSet* scene,
  const std::vector<Part>& parts, const std::string& folder)
{
  const File table = Open(folder + "/Parts.csv");
  std::fprintf(table.get(),
    "part,area_m2,mean_dose_J_m2,least_dose_J_m2,most_dose_J_m2,under_m2,over_m2,undecided_m2\n");
  for (const Cure& row : rows)
  {
    std::fprintf(table.get(), "%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", row.Name.c_str(),
      row.Area, row.MeanDose, row.LeastDose, row.MostDose, row.UnderArea, row.OverArea,
      row.OpenArea);
  }

  const File cells = Open(folder + "/Cells.csv");
  std::fprintf(cells.get(), "part,cell,x_m,y_m,z_m,area_m2,dose_J_m2,half_width_J_m2,cure\n");
  const std::vector<vtkPolyData*> meshes = PartsOf(scene);
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    vtkNew<vtkCellCenters> centers; // in the part's own frame
    centers->SetInputData(parts[part].Mesh);
    centers->Update();
    vtkCellData* data = meshes[part]->GetCellData();
    for (vtkIdType i = 0; i < meshes[part]->GetNumberOfCells(); ++i)
    {
      const double* x = centers->GetOutput()->GetPoint(i);
      std::fprintf(cells.get(), "%s,%lld,%.9g,%.9g,%.9g,%.17g,%.17g,%.17g,%d\n",
        parts[part].Name.c_str(), static_cast<long long>(i), x[0], x[1], x[2],
        data->GetArray("Area")->GetTuple1(i), data->GetArray("RadiantExposure")->GetTuple1(i),
        data->GetArray("HalfWidth")->GetTuple1(i), int(data->GetArray("Cure")->GetTuple1(i)));
    }
  }
}

}
