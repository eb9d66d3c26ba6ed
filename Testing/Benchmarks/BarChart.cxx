#include "BarChart.h"

#include "ChartPicture.h"
#include "ResultTable.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkColorSeries.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlot.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>

namespace
{

/// Rows are the groups of bars; after the groups' places there is a column for each colour.
vtkSmartPointer<vtkTable> makeTable(const std::vector<Result>& results,
  const std::vector<std::string>& groups, const std::vector<std::string>& series)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  const auto addColumn = [&](const std::string& name) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name.c_str());
    column->SetNumberOfValues(static_cast<vtkIdType>(groups.size()));
    column->Fill(0);
    table->AddColumn(column);
    return column.Get();
  };
  vtkDoubleArray* places = addColumn("place");
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    places->SetValue(static_cast<vtkIdType>(group), static_cast<double>(group));
  }
  for (const std::string& name : series)
  {
    vtkDoubleArray* values = addColumn(name);
    for (const Result& result : results)
    {
      const auto group = std::find(groups.begin(), groups.end(), result.quantity) - groups.begin();
      if (result.row == name)
      {
        values->SetValue(group, result.spread.median);
      }
    }
  }
  return table;
}

/// Whether a column is the unit of the others, which needs no bars.
bool isUnit(vtkTable* table, vtkIdType column)
{
  const double* range = vtkDataArray::SafeDownCast(table->GetColumn(column))->GetRange();
  return range[0] == 1 && range[1] == 1;
}

void addBars(vtkChartXY* chart, vtkTable* table)
{
  vtkNew<vtkColorSeries> colors;
  colors->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_PAIRED);
  for (vtkIdType column = 1; column < table->GetNumberOfColumns(); ++column)
  {
    if (isUnit(table, column))
    {
      continue;
    }
    vtkPlot* bars = chart->AddPlot(vtkChart::BAR);
    bars->SetInputData(table, 0, column);
    const vtkColor3ub color = colors->GetColorRepeating(static_cast<int>(column - 1));
    bars->SetColor(color.GetRed(), color.GetGreen(), color.GetBlue(), 255);
  }
}

void labelAxes(
  vtkChartXY* chart, const std::vector<std::string>& groups, const std::string& valueTitle)
{
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    places->InsertNextValue(static_cast<double>(group));
    labels->InsertNextValue(groups[group]);
  }
  vtkAxis* bottom = chart->GetAxis(vtkAxis::BOTTOM);
  bottom->SetCustomTickPositions(places, labels);
  bottom->SetBehavior(vtkAxis::FIXED);
  bottom->SetRange(-0.5, static_cast<double>(groups.size()) - 0.5);
  bottom->SetTitle("");
  bottom->SetGridVisible(false);
  chart->GetAxis(vtkAxis::LEFT)->SetTitle(valueTitle);
}

}

void writeBarChart(
  const std::string& path, const std::string& valueTitle, const std::vector<Result>& results)
{
  const std::vector<std::string> groups = distinct(results, &Result::quantity);
  vtkNew<vtkChartXY> chart;
  addBars(chart, makeTable(results, groups, distinct(results, &Result::row)));
  labelAxes(chart, groups, valueTitle);
  writePicture(chart, path);
}
