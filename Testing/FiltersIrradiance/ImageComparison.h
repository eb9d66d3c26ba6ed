// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageComparison_h
#define ImageComparison_h

#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>

/// Shows cells in colours that depend on the numbers alone, and compares the picture with
/// Baseline/<name>.png. Where there is none, the test fails and the picture is left in the build
/// folder: look at it, then copy it.
class Picture
{
public:
  Picture(const std::array<double, 3>& cameraPosition, const std::array<double, 3>& focus);

  /// What the cells emit and reflect, from 0 (black) to `brightest`, W/m2: grey, or the three bands
  /// as red, green and blue; by its square root, near to what displays expect.
  void Add(vtkPolyData* polyData, double brightest);

  /// True if picture and baseline agree. A picture that is expected to, and does not, is written to
  /// the build folder.
  bool IsSame(const std::string& name, bool isExpected);

private:
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkRenderWindow> Window;
};

#endif
