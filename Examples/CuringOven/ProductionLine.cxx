// SPDX-License-Identifier: BSD-3-Clause
#include "ProductionLine.h"

#include "Meshes.h"
#include "Oven.h"

#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkCleanPolyData.h>
#include <vtkIrradianceFilter.h>
#include <vtkKeyFramedPose.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <stdexcept>

namespace curingoven
{
namespace
{

// As triangles, cut into smaller ones until there are enough of them: each cell gets one dose.
vtkSmartPointer<vtkPolyData> Cut(vtkPolyData* mesh, const std::string& file, int cells)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  vtkNew<vtkCleanPolyData> merged; // .stl repeats the points of each triangle
  merged->SetInputConnection(triangles->GetOutputPort());
  merged->ConvertPolysToLinesOff();
  merged->Update();
  vtkSmartPointer<vtkPolyData> cut = merged->GetOutput();
  if (cut->GetNumberOfCells() == 0)
  {
    throw std::runtime_error(file + ": no cell has an area");
  }
  double edge = mesh->GetLength();
  while (cut->GetNumberOfCells() < cells)
  {
    edge *= 0.8;
    vtkNew<vtkAdaptiveSubdivisionFilter> smaller;
    smaller->SetInputConnection(merged->GetOutputPort());
    smaller->SetMaximumEdgeLength(edge);
    smaller->SetMaximumTriangleArea(VTK_DOUBLE_MAX); // a limit to it would open gaps
    smaller->Update();
    cut = smaller->GetOutput();
  }
  return cut;
}

Part ReadPart(const std::string& word, const OvenOptions& options)
{
  const std::size_t equal = word.find('=');
  const std::string file = equal == std::string::npos ? word : word.substr(equal + 1);
  const std::string name = equal == std::string::npos
    ? vtksys::SystemTools::GetFilenameWithoutLastExtension(file)
    : word.substr(0, equal);
  try
  {
    const auto mesh = movingteapot::ReadMeshFile(file);
    double b[6];
    mesh->GetBounds(b);
    double longest = std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
    if (!(longest > 0))
    {
      throw std::runtime_error(file + ": all points are in one place");
    }
    longest = options.Unit > 0 ? longest * options.Unit : options.PartSize;
    const auto fitted = movingteapot::FitMesh(
      mesh, { -longest / 2, longest / 2, -longest / 2, longest / 2, Lift, Lift + longest });
    fitted->GetBounds(b);
    if (b[5] > options.Opening || b[3] > options.OvenWidth / 2 || b[1] > Spacing / 2)
    {
      char size[160];
      std::snprintf(size, sizeof size,
        ": %g x %g x %g m is too large; %g x %g x %g m fit (see --unit and --part-size)",
        b[1] - b[0], b[3] - b[2], b[5] - b[4], Spacing, options.OvenWidth, options.Opening - Lift);
      throw std::runtime_error(file + size);
    }
    return { name, Cut(fitted, file, options.Cells) };
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(std::string("--part: ") + error.what());
  }
}

}

std::vector<Part> ReadParts(const OvenOptions& options)
{
  std::vector<std::string> words = options.Parts;
  if (words.empty())
  {
    for (const char* name : { "rotor", "pinion", "anchor", "joint", "couplingdown" })
    {
      words.push_back(std::string(MOVINGTEAPOT_DATA "/downloaded/") + name + ".off");
      if (!vtksys::SystemTools::FileExists(words.back(), true))
      {
        throw std::runtime_error("--part: none is given, and Data/fetch.sh has fetched none");
      }
    }
  }
  std::vector<Part> parts;
  for (const std::string& word : words)
  {
    Part part = ReadPart(word, options);
    for (const Part& other : parts)
    {
      if (other.Name == part.Name)
      {
        throw std::runtime_error(
          "--part: two parts have the name \"" + part.Name + "\"; NAME=FILE gives another one");
      }
    }
    movingteapot::SetName(part.Mesh, part.Name);
    parts.push_back(part);
  }
  return parts;
}

double EntryTime(const OvenOptions& options, int part)
{
  return part * Spacing / options.Speed;
}

double ExitTime(const OvenOptions& options, int part)
{
  return EntryTime(options, part) + 2 * BeltEnd(options) / options.Speed;
}

vtkSmartPointer<vtkIrradianceFilter> MakeLight(
  const OvenOptions& options, const std::vector<Part>& parts, int walks)
{
  auto light = vtkSmartPointer<vtkIrradianceFilter>::New();
  for (vtkPolyData* mesh : MakeOven(options))
  {
    light->AddInputDataObject(0, mesh);
  }
  for (int i = 0; i < int(parts.size()); ++i)
  {
    vtkNew<vtkKeyFramedPose> ride; // at constant speed along x
    ride->SetInputData(parts[i].Mesh);
    ride->AddPose(EntryTime(options, i), -BeltEnd(options), 0, 0, 0, 0, 0);
    ride->AddPose(ExitTime(options, i), BeltEnd(options), 0, 0, 0, 0, 0);
    ride->SetOutsideOfKeysToLeave();
    light->AddInputConnection(1, ride->GetOutputPort());
  }
  light->SetDefaultDiffuseReflectance(0.2); // of the parts' coating
  light->SetNumberOfWalks(walks);
  light->ComputeStandardErrorOn();
  // All parts move: with a method that gathers each would look for the lights again at each time.
  light->SetMethodToWalks();
  if (options.Spread > 0)
  {
    light->SetMethodToSpreadWalks();
    light->SetNumberOfSpreadPhotons(options.Spread);
  }
  return light;
}

}
