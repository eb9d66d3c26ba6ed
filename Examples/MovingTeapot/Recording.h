// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Options.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkColorTransferFunction;
class vtkMultiBlockDataSet;
class vtkOggTheoraWriter;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkRenderWindow;
class vtkTextActor;

namespace movingteapot
{

/**
 * What stays of a run, in one folder: MovingTeapot.pvd for ParaView, which lists
 * MovingTeapot/MovingTeapot_0000.vtm and so on; with pictures, one PNG per frame in pictures/ and
 * the movie MovingTeapot.ogv. Whatever is there after any frame can be opened. Throws
 * std::runtime_error when something cannot be written, or pictures cannot be drawn.
 */
class Recording
{
public:
  explicit Recording(const Options& options);
  ~Recording();

  /**
   * Adds the scene as it comes out of vtkIrradianceFilter. Frames come in order, from 0. `caption`
   * goes into the picture.
   */
  void Add(int frame, double time, vtkMultiBlockDataSet* scene, const std::string& caption);

private:
  void SetUpWindow(int width, int height);
  void AddActor(bool isRoom, bool isLamp);
  void AddToSeries(int frame, double time, vtkMultiBlockDataSet* scene);
  void AddPicture(int frame, vtkMultiBlockDataSet* scene, const std::string& caption);

  std::string Folder;
  std::string DataSets; // what the .pvd lists
  bool Pictures;
  int Smoothings; // of head and teapot; walls are not smoothed
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkColorTransferFunction> Colors;
  vtkNew<vtkTextActor> Caption;
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> Mappers; // one per mesh of the scene
  vtkNew<vtkOggTheoraWriter> Movie;
};

}
