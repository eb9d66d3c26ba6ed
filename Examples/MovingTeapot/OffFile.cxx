// SPDX-License-Identifier: BSD-3-Clause
#include "OffFile.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace movingteapot
{
namespace
{

// The lines of the file that say something: comments and blank lines are passed over.
class LineReader
{
public:
  explicit LineReader(const std::string& path)
    : Path(path)
    , File(path)
  {
    if (!this->File)
    {
      throw std::runtime_error(path + ": cannot be opened");
    }
  }

  std::istringstream Next()
  {
    std::string line;
    while (std::getline(this->File, line))
    {
      ++this->Number;
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(" \t\r") != std::string::npos)
      {
        return std::istringstream(line);
      }
    }
    this->Fail("the file ends too early");
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw std::runtime_error(this->Path + ", line " + std::to_string(this->Number) + ": " + what);
  }

private:
  std::string Path;
  std::ifstream File;
  int Number = 0;
};

struct Counts
{
  vtkIdType Points = 0;
  vtkIdType Polygons = 0;
};

Counts ReadHeader(LineReader& lines)
{
  std::istringstream line = lines.Next();
  std::string word;
  line >> word;
  if (word != "OFF")
  {
    lines.Fail("\"OFF\" expected, found \"" + word + "\"");
  }
  Counts counts;
  if (!(line >> counts.Points)) // the counts stand on the line of the word, or on the next
  {
    line = lines.Next();
    line >> counts.Points;
  }
  line >> counts.Polygons;
  if (!line || counts.Points < 0 || counts.Polygons < 0)
  {
    lines.Fail("the numbers of points and polygons expected");
  }
  return counts;
}

void ReadPoints(LineReader& lines, vtkIdType count, vtkPoints* points)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::istringstream line = lines.Next();
    double x[3];
    if (!(line >> x[0] >> x[1] >> x[2]))
    {
      lines.Fail("three coordinates expected");
    }
    points->InsertNextPoint(x);
  }
}

void ReadPolygons(LineReader& lines, const Counts& counts, vtkCellArray* polygons)
{
  for (vtkIdType i = 0; i < counts.Polygons; ++i)
  {
    std::istringstream line = lines.Next();
    vtkIdType size = 0;
    if (!(line >> size) || size < 1 || size > counts.Points)
    {
      lines.Fail("a polygon's number of points expected");
    }
    std::vector<vtkIdType> polygon(size);
    for (vtkIdType& id : polygon)
    {
      if (!(line >> id) || id < 0 || id >= counts.Points)
      {
        lines.Fail("a point number from 0 to " + std::to_string(counts.Points - 1) + " expected");
      }
    }
    if (size >= 3)
    {
      polygons->InsertNextCell(size, polygon.data());
    }
  }
}

}

vtkSmartPointer<vtkPolyData> ReadOffFile(const std::string& path)
{
  LineReader lines(path);
  const Counts counts = ReadHeader(lines);
  vtkNew<vtkPoints> points;
  ReadPoints(lines, counts.Points, points);
  vtkNew<vtkCellArray> polygons;
  ReadPolygons(lines, counts, polygons);

  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return mesh;
}

}
