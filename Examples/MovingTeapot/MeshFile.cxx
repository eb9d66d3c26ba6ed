// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFile.h"

#include "VtkErrors.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace movingteapot
{
namespace
{

template <typename VtkReader>
vtkSmartPointer<vtkPolyData> ReadWith(const std::string& path)
{
  const VtkErrors errors;
  vtkNew<VtkReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  errors.ThrowIfAny(path + " cannot be read");
  return reader->GetOutput();
}

// The lines of a file that say something: comments and blank lines are passed over.
class LineReader
{
public:
  explicit LineReader(const std::string& path)
    : Path(path)
    , File(path)
  {
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
    throw this->Error("the file ends too early");
  }

  void Require(bool good, const std::string& what) const
  {
    if (!good)
    {
      throw this->Error(what);
    }
  }

private:
  std::runtime_error Error(const std::string& what) const
  {
    return std::runtime_error(this->Path + ", line " + std::to_string(this->Number) + ": " + what);
  }

  std::string Path;
  std::ifstream File;
  int Number = 0;
};

std::vector<vtkIdType> ReadPolygon(LineReader& lines, vtkIdType numberOfPoints)
{
  std::istringstream line = lines.Next();
  vtkIdType size = 0;
  lines.Require(
    (line >> size) && size >= 1 && size <= numberOfPoints, "a polygon's number of points expected");
  std::vector<vtkIdType> polygon(size);
  for (vtkIdType& id : polygon)
  {
    lines.Require((line >> id) && id >= 0 && id < numberOfPoints,
      "a point number from 0 to " + std::to_string(numberOfPoints - 1) + " expected");
  }
  return polygon;
}

// The Object File Format of Geomview (ASCII), for which VTK 9.1 has no reader. Colours are passed over.
vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path)
{
  LineReader lines(path);
  std::istringstream line = lines.Next();
  std::string word;
  line >> word;
  lines.Require(word == "OFF", "\"OFF\" expected, found \"" + word + "\"");
  vtkIdType numberOfPoints = 0, numberOfPolygons = 0;
  if (!(line >> numberOfPoints)) // the counts stand on the line of the word, or on the next
  {
    line = lines.Next();
    line >> numberOfPoints;
  }
  line >> numberOfPolygons;
  lines.Require(line && numberOfPoints >= 0 && numberOfPolygons >= 0,
    "the numbers of points and polygons expected");

  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    line = lines.Next();
    double x[3];
    lines.Require(bool(line >> x[0] >> x[1] >> x[2]), "three coordinates expected");
    points->InsertNextPoint(x);
  }
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType i = 0; i < numberOfPolygons; ++i)
  {
    const std::vector<vtkIdType> polygon = ReadPolygon(lines, numberOfPoints);
    if (polygon.size() >= 3)
    {
      polygons->InsertNextCell(polygon.size(), polygon.data());
    }
  }

  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return mesh;
}

using Reader = vtkSmartPointer<vtkPolyData> (*)(const std::string& path);

const std::map<std::string, Reader> ReaderOfExtension = {
  { ".obj", ReadWith<vtkOBJReader> },
  { ".ply", ReadWith<vtkPLYReader> },
  { ".stl", ReadWith<vtkSTLReader> },
  { ".vtp", ReadWith<vtkXMLPolyDataReader> },
  { ".vtk", ReadWith<vtkPolyDataReader> },
  { ".off", ReadOff },
};

}

vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& path)
{
  using vtksys::SystemTools;
  if (!SystemTools::FileExists(path, true))
  {
    throw std::runtime_error(path + ": there is no such file");
  }
  const auto reader =
    ReaderOfExtension.find(SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(path)));
  if (reader == ReaderOfExtension.end())
  {
    throw std::runtime_error(
      path + ": unknown kind of file; .obj .ply .stl .vtp .vtk .off are read");
  }
  vtkSmartPointer<vtkPolyData> mesh = reader->second(path);
  if (mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() == 0)
  {
    throw std::runtime_error(path + ": there is no polygon in it");
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> FitMesh(vtkPolyData* mesh, const Box& box)
{
  double from[6];
  mesh->GetBounds(from);
  double scale = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double extent = from[2 * axis + 1] - from[2 * axis];
    const double room = box[2 * axis + 1] - box[2 * axis];
    scale = extent > 0.0 ? std::min(scale, room / extent) : scale;
  }

  vtkNew<vtkTransform> boxFromMesh;
  boxFromMesh->Translate((box[0] + box[1]) / 2, (box[2] + box[3]) / 2, box[4]);
  boxFromMesh->Scale(scale, scale, scale);
  boxFromMesh->Translate(-(from[0] + from[1]) / 2, -(from[2] + from[3]) / 2, -from[4]);
  vtkNew<vtkTransformPolyDataFilter> fit;
  fit->SetInputData(mesh);
  fit->SetTransform(boxFromMesh);
  fit->Update();
  return fit->GetOutput();
}

}
