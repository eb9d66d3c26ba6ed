// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CameraRays.h"
#include "Estimates.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkCamera;
class vtkImageData;

namespace pathtracedroom
{

/** A pinhole camera where a VTK camera stands. Throws std::invalid_argument for a parallel projection. */
CameraRays MakeCameraRays(vtkCamera* camera, int width, int height);

/** The point arrays `Radiance` and `RadianceStandardError` (from two passes on), W/m2/sr, with one
    component for each band. */
vtkSmartPointer<vtkImageData> MakeImage(const Estimates& pixels, int width, int height, int bands);

/** Writes `Radiance` as a PNG. Tone mapping: 1 - exp(-exposure x radiance) in each band, then the curve
    of sRGB. One band is grey. */
void WritePicture(vtkImageData* image, double exposure, const std::string& file);

}
