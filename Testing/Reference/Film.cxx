// SPDX-License-Identifier: BSD-3-Clause
#include "Film.h"

#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <stdexcept>

namespace pathtracedroom
{
namespace
{

// The n-th value of a bin as a tuple of the bands.
template <typename Values>
vtkSmartPointer<vtkDoubleArray> MakeArray(
  const char* name, vtkIdType tuples, int bands, const Values& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(bands);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    const Spectrum value = values(std::size_t(i));
    array->SetTuple(i, value.data());
  }
  return array;
}

unsigned char ToneOf(double radiance, double exposure)
{
  const double tone = 1 - std::exp(-exposure * radiance);
  const double coded =
    tone <= 0.0031308 ? 12.92 * tone : 1.055 * std::pow(tone, 1 / 2.4) - 0.055; // IEC 61966-2-1
  return static_cast<unsigned char>(std::lround(255 * coded));
}

}

CameraRays MakeCameraRays(vtkCamera* camera, int width, int height)
{
  if (camera->GetParallelProjection())
  {
    throw std::invalid_argument("a camera with parallel projection has no pinhole");
  }
  CameraRays::View view;
  camera->GetPosition(view.position.data());
  camera->GetDirectionOfProjection(view.forward.data());
  camera->GetViewUp(view.up.data());
  view.angle = vtkMath::RadiansFromDegrees(camera->GetViewAngle());
  view.width = width;
  view.height = height;
  return CameraRays(view);
}

vtkSmartPointer<vtkImageData> MakeImage(const Estimates& pixels, int width, int height, int bands)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  const vtkIdType count = image->GetNumberOfPoints();
  image->GetPointData()->SetScalars(
    MakeArray("Radiance", count, bands, [&](std::size_t bin) { return pixels.mean(bin); }));
  if (pixels.passes() > 1)
  {
    image->GetPointData()->AddArray(MakeArray("RadianceStandardError", count, bands,
      [&](std::size_t bin) { return pixels.standardError(bin); }));
  }
  return image;
}

void WritePicture(vtkImageData* image, double exposure, const std::string& file)
{
  vtkDataArray* radiance = image->GetPointData()->GetArray("Radiance");
  vtkNew<vtkUnsignedCharArray> tones;
  tones->SetNumberOfComponents(radiance->GetNumberOfComponents());
  tones->SetNumberOfTuples(radiance->GetNumberOfTuples());
  for (vtkIdType i = 0; i < tones->GetNumberOfTuples(); ++i)
  {
    for (int band = 0; band < tones->GetNumberOfComponents(); ++band)
    {
      tones->SetTypedComponent(i, band, ToneOf(radiance->GetComponent(i, band), exposure));
    }
  }
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(image->GetDimensions());
  picture->GetPointData()->SetScalars(tones);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw std::runtime_error(file + " cannot be written");
  }
}

}
