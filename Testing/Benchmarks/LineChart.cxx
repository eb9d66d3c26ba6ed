#include "LineChart.h"

#include "ChartPicture.h"
#include "ResultTable.h"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkColorSeries.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>

#include <algorithm>
#include <limits>

namespace
{

struct Line
{
  std::string name;
  std::vector<double> x, y;
};

double valueOf(
  const std::vector<Result>& results, const std::string& row, const std::string& quantity)
{
  const auto found = std::find_if(results.begin(), results.end(),
    [&](const Result& result) { return result.row == row && result.quantity == quantity; });
  return found == results.end() ? std::numeric_limits<double>::quiet_NaN() : found->spread.median;
}

std::vector<Line> linesOf(
  const std::vector<Result>& results, const std::string& x, const std::string& y)
{
  std::vector<Line> lines;
  for (const std::string& row : distinct(results, &Result::row))
  {
    const std::string name = row.substr(0, row.rfind(','));
    auto line =
      std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.name == name; });
    if (line == lines.end())
    {
      line = lines.insert(line, { name, {}, {} });
    }
    line->x.push_back(valueOf(results, row, x));
    line->y.push_back(valueOf(results, row, y));
  }
  return lines;
}

vtkSmartPointer<vtkTable> tableOf(const Line& line)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  for (const std::vector<double>* values : { &line.x, &line.y })
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(values == &line.x ? "place" : line.name.c_str());
    std::for_each(
      values->begin(), values->end(), [&](double value) { column->InsertNextValue(value); });
    table->AddColumn(column);
  }
  return table;
}

/// `mark`: the number of the mark's shape.
void addLine(vtkChartXY* chart, const Line& line, const vtkColor3ub& color, int mark)
{
  constexpr int kMarks[] = { vtkPlotPoints::DIAMOND, vtkPlotPoints::SQUARE, vtkPlotPoints::PLUS,
    vtkPlotPoints::CROSS };
  const bool isPoint = line.x.size() == 1;
  auto* plot =
    vtkPlotPoints::SafeDownCast(chart->AddPlot(isPoint ? vtkChart::POINTS : vtkChart::LINE));
  plot->SetInputData(tableOf(line), 0, 1);
  plot->SetColor(color.GetRed(), color.GetGreen(), color.GetBlue(), 255);
  plot->SetMarkerStyle(isPoint ? kMarks[mark % 4] : vtkPlotPoints::CIRCLE);
  plot->SetMarkerSize(isPoint ? 16 : 9);
  plot->SetWidth(isPoint ? 3 : 2);
}

/// `largest`: of the values on it.
void setAxis(vtkAxis* axis, const LineAxis& what, double largest)
{
  constexpr double kRoom = 1.05;
  axis->SetTitle(what.quantity);
  axis->SetLogScale(what.isLogarithmic);
  if (!what.isLogarithmic)
  {
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(0, kRoom * largest);
  }
}

double largestOf(const std::vector<Line>& lines, std::vector<double> Line::*values)
{
  double largest = 0;
  for (const Line& line : lines)
  {
    largest = std::max(largest, *std::max_element((line.*values).begin(), (line.*values).end()));
  }
  return largest;
}

std::size_t placeIn(std::vector<std::string>& names, const std::string& name)
{
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end())
  {
    names.push_back(name);
  }
  return place;
}

}

void writeLineChart(const std::string& path, const LineAxis& bottom, const LineAxis& left,
  const std::vector<Result>& results)
{
  vtkNew<vtkChartXY> chart;
  vtkNew<vtkColorSeries> colors;
  colors->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_DARK2);
  std::vector<std::string> groups, marks;
  const std::vector<Line> lines = linesOf(results, bottom.quantity, left.quantity);
  for (const Line& line : lines)
  {
    const std::size_t comma = std::min(line.name.find(','), line.name.size());
    const std::size_t group = placeIn(groups, line.name.substr(0, comma));
    const std::size_t mark = placeIn(marks, line.name.substr(comma));
    addLine(
      chart, line, colors->GetColorRepeating(static_cast<int>(group)), static_cast<int>(mark));
  }
  setAxis(chart->GetAxis(vtkAxis::BOTTOM), bottom, largestOf(lines, &Line::x));
  setAxis(chart->GetAxis(vtkAxis::LEFT), left, largestOf(lines, &Line::y));
  writePicture(chart, path);
}
