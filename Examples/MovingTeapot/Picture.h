// SPDX-License-Identifier: BSD-3-Clause
/** Draws the scene in the colours of its irradiance. */
#ifndef Picture_h
#define Picture_h

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkActor;
class vtkColorTransferFunction;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkRenderWindow;
class vtkTextActor;

namespace movingteapot
{

/** Whether a window can be opened here: VTK itself ends the program where it cannot. */
bool HasDisplay();

class Picture
{
public:
  /** Width and height in pixels. Head and teapot are smoothed (see Smoothing.h), walls are not. */
  Picture(int width, int height, int smoothingPasses);
  ~Picture();

  /**
   * The scene as it comes out of vtkIrradianceFilter, seen from outside through the front wall.
   * The first scene fixes the range of the colours for all that follow.
   */
  vtkSmartPointer<vtkImageData> Draw(vtkMultiBlockDataSet* scene, const std::string& caption);

private:
  void AddActor(bool isRoom, bool isLamp);
  void SetUp(const std::vector<vtkPolyData*>& meshes);
  void AddColorBar();
  void AddCaption();
  void PlaceCamera();

  int Height;
  int SmoothingPasses;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkColorTransferFunction> Colors;
  vtkNew<vtkTextActor> Caption;
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> Mappers; // one per mesh of the scene
};

}

#endif
