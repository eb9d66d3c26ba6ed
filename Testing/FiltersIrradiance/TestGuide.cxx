// SPDX-License-Identifier: BSD-3-Clause
// The C++ lines of Documentation/Guide.md run without an error, each block in a scene of its own.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkBeamLightSource.h"
#include "vtkImageData.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkKeyFramedPose.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkOutputWindow.h"
#include "vtkPhotonWalksFilter.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkRenderer.h"
#include "vtkSunSkySource.h"

#include <gtest/gtest.h>

using namespace TestScenes;

/// What the page presupposes.
class Guide : public testing::Test
{
protected:
  Guide()
  {
    irradiance->SetMaximumNumberOfWalks(20000);
    sensors->ShallowCopy(MakeRectangle({ 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2));
    SetNormals(sensors, { { 0, 0, 1 } });
    volume->SetDimensions(3, 3, 3);
    vtkOutputWindow::GetInstance()->AddObserver(vtkCommand::ErrorEvent, errors);
  }

  void TearDown() override
  {
    vtkOutputWindow::GetInstance()->RemoveObserver(errors);
    EXPECT_TRUE(errors->Errors.empty()) << testing::PrintToString(errors->Errors);
    EXPECT_EQ(irradiance->GetOutput()->GetNumberOfBlocks(), 2u) << "the block updates nothing";
  }

  vtkSmartPointer<vtkIrradianceFilter> irradiance = MakeDefaultFilter(MakeSmallScene(), 5000);
  vtkNew<vtkSphereSource> part;
  vtkNew<vtkPolyData> sensors;
  vtkNew<vtkImageData> volume;
  vtkNew<vtkRenderer> renderer;
  vtkNew<ErrorObserver> errors;
};

#include "GuideLines.inl"
