#include "ResultFile.h"

#include <vtkDelimitedTextReader.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace
{

const char* const kColumns[] = { "benchmark", "row", "quantity", "median", "smallest", "largest",
  "bar", "aim" };

std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return std::isnan(value) ? "" : text;
}

double numberAt(vtkTable* table, vtkIdType row, const char* column)
{
  bool isNumber = false;
  const double number = table->GetValueByName(row, column).ToDouble(&isNumber);
  return isNumber ? number : std::nan("");
}

}

void writeResults(const std::string& path, const std::vector<Result>& results)
{
  vtkNew<vtkTable> table;
  for (const char* name : kColumns)
  {
    vtkNew<vtkStringArray> column;
    column->SetName(name);
    table->AddColumn(column);
  }
  for (const Result& result : results)
  {
    const vtkIdType row = table->InsertNextBlankRow();
    const std::string cells[] = { result.benchmark, result.row, result.quantity,
      textOf(result.spread.median), textOf(result.spread.smallest), textOf(result.spread.largest),
      textOf(result.goal.bar), textOf(result.goal.aim) };
    for (vtkIdType column = 0; column < table->GetNumberOfColumns(); ++column)
    {
      table->SetValue(row, column, vtkVariant(cells[column]));
    }
  }
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(table);
  writer->SetFileName(path.c_str());
  if (!writer->Write())
  {
    throw std::runtime_error(path + ": cannot be written");
  }
}

std::vector<Result> readResults(const std::string& path)
{
  vtkNew<vtkDelimitedTextReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetHaveHeaders(true);
  reader->SetFieldDelimiterCharacters(",");
  reader->SetStringDelimiter('"');
  reader->UseStringDelimiterOn();
  reader->Update();
  vtkTable* table = reader->GetOutput();
  for (const char* column : kColumns)
  {
    if (!table->GetColumnByName(column))
    {
      throw std::runtime_error(path + ": no column \"" + column + "\", so no results");
    }
  }
  std::vector<Result> results;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto text = [&](const char* column) {
      return static_cast<std::string>(table->GetValueByName(row, column).ToString());
    };
    const auto number = [&](const char* column) { return numberAt(table, row, column); };
    results.push_back({ text("benchmark"), text("row"), text("quantity"),
      { number("median"), number("smallest"), number("largest") },
      { number("bar"), number("aim") } });
  }
  return results;
}
