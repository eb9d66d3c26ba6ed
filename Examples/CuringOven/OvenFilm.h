// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ProductionLine.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataArray;
class vtkDoubleArray;
class vtkMultiBlockDataSet;
class vtkOggTheoraWriter;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkRenderWindow;
class vtkTextActor;

namespace curingoven
{

/**
 * CuringOven.ogv, the ride through the oven: its walls in the colours of their irradiance, the
 * parts in the colours of their dose so far; CuringOven.png, its middle; and Parts.png, the parts
 * from above and below in the colours of their doses. Throws std::runtime_error when pictures
 * cannot be drawn or written.
 */
class OvenFilm
{
public:
  explicit OvenFilm(const OvenOptions& options);
  ~OvenFilm();

  /** The scene as it comes out of vtkIrradianceFilter. Steps come in order, from 0. */
  void AddFrame(int step, double time, vtkMultiBlockDataSet* scene);
  /** The scene as it comes out of vtkRadiantExposureFilter. */
  void WriteParts(vtkMultiBlockDataSet* scene, const std::vector<Part>& parts);

private:
  void SetUpRide();
  void AddDose(int part, double seconds, vtkPolyData* mesh);
  void Show(std::size_t mesh, vtkPolyData* shown);
  void Write(vtkRenderer* renderer, const std::string& file);

  const OvenOptions Options;
  vtkNew<vtkColorTransferFunction> IrradianceColors; // of kW/m2
  vtkNew<vtkColorTransferFunction> DoseColors;       // of kJ/m2
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Ride;
  vtkNew<vtkTextActor> Caption;
  vtkNew<vtkOggTheoraWriter> Movie;
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> Mappers; // one for each mesh of the scene
  std::vector<vtkSmartPointer<vtkDoubleArray>> Doses;      // kJ/m2, so far
  std::vector<vtkSmartPointer<vtkDataArray>> LastIrradiances;
  double LastTime = 0;
};

}
