// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFile.h"

#include "ErrorListener.h"
#include "OffFile.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkStringOutputWindow.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace movingteapot
{
namespace
{

// Keeps VTK from printing, as long as it lives: what matters is said by an exception.
class Silence
{
public:
  Silence()
    : Window(vtkOutputWindow::GetInstance())
    , Verbosity(vtkLogger::GetCurrentVerbosityCutoff())
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(vtkNew<vtkStringOutputWindow>());
  }
  ~Silence()
  {
    vtkOutputWindow::SetInstance(this->Window);
    vtkLogger::SetStderrVerbosity(this->Verbosity);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  vtkSmartPointer<vtkOutputWindow> Window;
  vtkLogger::Verbosity Verbosity;
};

// Runs one of VTK's readers; what it complains about becomes an exception.
template <typename VtkReader>
vtkSmartPointer<vtkPolyData> ReadWith(const std::string& path)
{
  const Silence silence;
  vtkNew<VtkReader> reader;
  ErrorListener errors(reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  errors.ThrowIfAny(path + " cannot be read");
  return reader->GetOutput();
}

using Reader = vtkSmartPointer<vtkPolyData> (*)(const std::string& path);

const std::map<std::string, Reader> ReaderOfExtension = {
  { ".obj", ReadWith<vtkOBJReader> },
  { ".ply", ReadWith<vtkPLYReader> },
  { ".stl", ReadWith<vtkSTLReader> },
  { ".vtp", ReadWith<vtkXMLPolyDataReader> },
  { ".vtk", ReadWith<vtkPolyDataReader> },
  { ".off", ReadOffFile },
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
