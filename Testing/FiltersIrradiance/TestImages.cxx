// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the results, and for each a scene that is a little wrong and must not pass.
// They need an X server: see Utilities/run-under-xvfb.sh.

#include "TestScenes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageDifference.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace TestScenes;

namespace
{

/// A component of a cell array; grey arrays serve all bands.
double ValueOf(vtkDataArray* array, vtkIdType cell, int band)
{
  return array->GetComponent(cell, array->GetNumberOfComponents() == 3 ? band : 0);
}

/// Reflected and emitted, W/m2.
double RadiosityOf(vtkCellData* cells, vtkIdType cell, int band)
{
  vtkDataArray* exitance = cells->GetArray("RadiantExitance");
  return ValueOf(cells->GetArray("DiffuseReflectance"), cell, band) *
    ValueOf(cells->GetArray("Irradiance"), cell, band) +
    (exitance ? ValueOf(exitance, cell, band) : 0);
}

void Write(vtkAlgorithm* image, const std::string& name, bool isWanted)
{
  if (isWanted)
  {
    const std::string path = VTKIRRADIANCE_OUTPUT_DIR "/" + name + ".png";
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(image->GetOutputPort());
    writer->SetFileName(path.c_str());
    writer->Write();
    std::cout << "Look at " << path << "\n";
  }
}

/// Shows cells in colours that depend on the numbers alone, and compares the picture with
/// Baseline/<name>.png. Without a baseline the test fails and leaves the picture in the build
/// folder, to be looked at and copied.
class Picture
{
public:
  Picture(const Vector& cameraPosition, const Vector& focus)
  {
    this->Window->SetMultiSamples(0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetSize(300, 300);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetBackground(0.2, 0.2, 0.3);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(cameraPosition.data());
    camera->SetFocalPoint(focus.data());
    camera->SetViewUp(0, 0, 1);
    camera->SetViewAngle(40);
  }

  /// Adds cells by what they emit and reflect, from 0 (black) to `brightest`, W/m2: grey, or the
  /// bands as red, green and blue. Colours are its square root, close to what displays expect.
  void Add(vtkIrradianceFilter* filter, unsigned int port, unsigned int i, double brightest)
  {
    vtkPolyData* polyData = OutputOf(filter->GetOutput(), port, i);
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetName("Colours");
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(polyData->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < polyData->GetNumberOfCells(); ++cell)
    {
      for (int band = 0; band < 3; ++band)
      {
        const double part = RadiosityOf(polyData->GetCellData(), cell, band) / brightest;
        colours->SetComponent(cell, band, std::round(255 * std::sqrt(std::clamp(part, 0.0, 1.0))));
      }
    }
    vtkNew<vtkPolyData> shown;
    shown->CopyStructure(polyData);
    shown->GetCellData()->SetScalars(colours);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(shown);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->BackfaceCullingOn(); // shows rooms through their walls
    this->Renderer->AddActor(actor);
  }

  // vtkTesting's comparison does not serve: its vtkImageDifference forgives a difference of 105 (of
  // 3 * 255) in every pixel, so a red wall passes for a green one.

  /// Whether picture and baseline agree. A picture that should agree and does not is written to the
  /// build folder.
  bool IsSame(const std::string& name, bool isExpected)
  {
    constexpr int forgivenOfAPixel = 16;
    constexpr double largestError = 10;

    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(this->Window);
    picture->ReadFrontBufferOff();
    picture->Update();
    const std::string baseline = VTKIRRADIANCE_BASELINE_DIR "/" + name + ".png";
    if (!vtksys::SystemTools::FileExists(baseline))
    {
      std::cout << "There is no " << baseline << "\n";
      Write(picture, name, isExpected);
      return false;
    }
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(baseline.c_str());
    vtkNew<vtkImageDifference> difference;
    difference->SetThreshold(forgivenOfAPixel);
    difference->SetInputConnection(picture->GetOutputPort());
    difference->SetImageConnection(reader->GetOutputPort());
    difference->Update();
    const double error = difference->GetThresholdedError();
    std::cout << name << ": error " << error << ", at most " << largestError << " pass\n";
    if (!(error <= largestError))
    {
      Write(picture, name, isExpected);
      Write(difference, name + ".difference", isExpected);
      return false;
    }
    return true;
  }

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// A ball above a floor under a small lamp.
Scene MakeBallOverFloor(double x)
{
  Mesh floor = MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 40);
  Mesh ball = MakeBall(0.5, 24);
  SetCellValues(floor, "DiffuseReflectance", { 0.3 });
  SetCellValues(ball, "DiffuseReflectance", { 0.6 });
  return { { floor, MakeLamp({ 0, 0, 3.5 }, 0.2, { 1000 }) }, { MakeMoving(ball, { x, 0, 0.9 }) } };
}

bool IsShadowOfTheBall(double x)
{
  const auto filter = MakeFilter(MakeBallOverFloor(x), 1000000);
  filter->Update();
  Picture picture({ 0, -7, 5 }, { 0, 0, 0.3 });
  picture.Add(filter, 0, 0, 1);
  picture.Add(filter, 1, 0, 1);
  return picture.IsSame("ShadowOfABall", x == 0);
}

/// A white room with a red wall on the left and a green one on the right.
Scene MakeColouredRoom(const std::vector<double>& left, const std::vector<double>& right)
{
  Mesh room = MakeRoom(3, 10);
  SetCellValues(room, "DiffuseReflectance", { 0.75, 0.75, 0.75 });
  vtkDataArray* reflectance = room->GetCellData()->GetArray("DiffuseReflectance");
  for (vtkIdType i = 0; i < 100; ++i)
  {
    reflectance->SetTuple(200 + i, left.data());
    reflectance->SetTuple(300 + i, right.data());
  }
  Mesh box = MakeBox(1, 0.8, 1.4);
  SetCellValues(box, "DiffuseReflectance", { 0.75, 0.75, 0.75 });
  Mesh lamp = MakeLamp({ 1.5, 1.5, 2.95 }, 1, { 100, 90, 75 });
  SetCellValues(lamp, "DiffuseReflectance", { 0 });
  Scene scene{ { room, lamp }, { MakeMoving(box, { 1.7, 1.7, 0.7 }) } };
  scene.Moving[0].Pose->RotateZ(25);
  return scene;
}

bool IsColouredRoom(const std::vector<double>& left, const std::vector<double>& right)
{
  const auto filter = MakeFilter(MakeColouredRoom(left, right), 300000);
  filter->Update();
  Picture picture({ 1.5, -4, 1.5 }, { 1.5, 1.5, 1.5 });
  picture.Add(filter, 0, 0, 20);
  picture.Add(filter, 0, 1, 20);
  picture.Add(filter, 1, 0, 20);
  return picture.IsSame("ColouredRoom", left[0] > left[1]);
}

/// A ball moves over the floor and a box turns; the picture shows the last of five frames.
bool IsWalkingBall(int frames)
{
  Scene scene = MakeBallOverFloor(-1.2);
  Mesh box = MakeBox(0.6, 0.6, 0.6);
  SetCellValues(box, "DiffuseReflectance", { 0.4 });
  scene.Moving.push_back(MakeMoving(box, { 0.8, 0.8, 0.31 }));
  const auto filter = MakeFilter(scene, 1000000);
  filter->Update();
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.2, -0.05, 0);
    scene.Moving[1].Pose->RotateZ(9);
    filter->Update();
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  }
  Picture picture({ 0, -7, 5 }, { 0, 0, 0.3 });
  picture.Add(filter, 0, 0, 1);
  picture.Add(filter, 1, 0, 1);
  picture.Add(filter, 1, 1, 1);
  return picture.IsSame("WalkingBall", frames == 5);
}

}

TEST(Images, ShadowOfABall)
{
  EXPECT_TRUE(IsShadowOfTheBall(0));
  EXPECT_FALSE(IsShadowOfTheBall(0.15)) << "a ball 15 cm beside it passes";
}

TEST(Images, ColouredRoom)
{
  const std::vector<double> red{ 0.75, 0.15, 0.15 }, green{ 0.15, 0.75, 0.15 };
  EXPECT_TRUE(IsColouredRoom(red, green));
  EXPECT_FALSE(IsColouredRoom(green, red)) << "exchanged walls pass";
}

TEST(Images, WalkingBall)
{
  EXPECT_TRUE(IsWalkingBall(5));
  EXPECT_FALSE(IsWalkingBall(4)) << "the frame before passes";
}
