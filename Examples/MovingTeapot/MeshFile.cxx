// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes.h"

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

  void Require(bool good, const std::string& what) const
  {
    if (!good)
    {
      throw std::runtime_error(this->Path + ", line " + std::to_string(this->Number) + ": " + what);
    }
  }

  // The next line, which begins with these values.
  template <typename... Values>
  std::istringstream Read(const std::string& expected, Values&... values)
  {
    std::string line;
    while (line.find_first_not_of(" \t\r") == std::string::npos)
    {
      this->Require(bool(std::getline(this->File, line)), "the file ends too early");
      ++this->Number;
      line = line.substr(0, line.find('#'));
    }
    std::istringstream words(line);
    this->Require(bool((words >> ... >> values)), expected + " expected");
    return words;
  }

private:
  std::string Path;
  std::ifstream File;
  int Number = 0;
};

std::vector<vtkIdType> ReadPolygon(LineReader& lines, vtkIdType numberOfPoints)
{
  const std::string number = "a polygon's number of points";
  vtkIdType size = 0;
  std::istringstream line = lines.Read(number, size);
  lines.Require(size >= 1 && size <= numberOfPoints, number + " expected");
  std::vector<vtkIdType> polygon(size);
  for (vtkIdType& id : polygon)
  {
    lines.Require((line >> id) && id >= 0 && id < numberOfPoints,
      "a point number from 0 to " + std::to_string(numberOfPoints - 1) + " expected");
  }
  return polygon;
}

// The Object File Format of Geomview (ASCII), for which VTK 9.1 has no reader. Colours are passed
// over.
vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path)
{
  LineReader lines(path);
  std::string word;
  std::istringstream line = lines.Read("\"OFF\"", word);
  lines.Require(word == "OFF", "\"OFF\" expected, found \"" + word + "\"");
  vtkIdType numberOfPoints = 0, numberOfPolygons = 0;
  if (!(line >> numberOfPoints >>
        numberOfPolygons)) // they stand on the line of the word, or the next
  {
    lines.Read("the numbers of points and polygons", numberOfPoints, numberOfPolygons);
  }

  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(vtkNew<vtkPoints>());
  mesh->SetPolys(vtkNew<vtkCellArray>());
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    double x[3];
    lines.Read("three coordinates", x[0], x[1], x[2]);
    mesh->GetPoints()->InsertNextPoint(x);
  }
  for (vtkIdType i = 0; i < numberOfPolygons; ++i)
  {
    const std::vector<vtkIdType> polygon = ReadPolygon(lines, numberOfPoints);
    if (polygon.size() >= 3)
    {
      mesh->GetPolys()->InsertNextCell(polygon.size(), polygon.data());
    }
  }
  return mesh;
}

}

vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& path)
{
  using vtksys::SystemTools;
  if (!SystemTools::FileExists(path, true))
  {
    throw std::runtime_error(path + ": there is no such file");
  }
  const std::string kind = SystemTools::LowerCase(SystemTools::GetFilenameLastExtension(path));
  const auto mesh = kind == ".obj" ? ReadWith<vtkOBJReader>(path)
    : kind == ".ply"               ? ReadWith<vtkPLYReader>(path)
    : kind == ".stl"               ? ReadWith<vtkSTLReader>(path)
    : kind == ".vtp"               ? ReadWith<vtkXMLPolyDataReader>(path)
    : kind == ".vtk"               ? ReadWith<vtkPolyDataReader>(path)
    : kind == ".off"               ? ReadOff(path)
                                   : nullptr;
  if (!mesh)
  {
    throw std::runtime_error(
      path + ": unknown kind of file; .obj .ply .stl .vtp .vtk .off are read");
  }
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
