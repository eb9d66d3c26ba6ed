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
/// Baseline/<name>.png. Without a baseline the test fails and leaves the picture in the build
/// folder, to be looked at and copied.
class Picture
{
public:
  Picture(const std::array<double, 3>& cameraPosition, const std::array<double, 3>& focus);

  /// Adds cells by what they emit and reflect, from 0 (black) to `brightest`, W/m2: grey, or the
  /// bands as red, green and blue. Colours are its square root, close to what displays expect.
  void Add(vtkPolyData* polyData, double brightest);

  /// Whether picture and baseline agree. A picture that should agree and does not is written to the
  /// build folder.
  bool IsSame(const std::string& name, bool isExpected);

private:
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkRenderWindow> Window;
};

#endif
