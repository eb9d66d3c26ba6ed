// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOutgoingRadianceFilter
 * @brief   radiance that leaves the cells of a vtkIrradianceFilter's scene towards an eye
 *
 * Adds what an eye sees of each cell: light that the cell emits, and light that it reflects
 * diffusely and specularly. The photons that vtkIrradianceFilter stores do not depend on the view,
 * so when the camera moves this filter alone executes.
 *
 * Section 4.2 of Szecsi, Benedek and Szirmay-Kalos, "Accelerating Animation Through Verification of
 * Shooting Walks" (SCCG 2003).
 *
 * @section RadianceInput Input
 * The whole output of a vtkIrradianceFilter, or a shallow copy. The photons come with it. A filter
 * that did not keep them, as nothing can move, executes again.
 *
 * @section RadianceOutput Output
 * A shallow copy of the input with the cell array `Radiance` (double, W/m2/sr, as many components as
 * `Irradiance`): the mean over the area of the cell of the radiance towards the eye. It is active.
 * - Emitted: RadiantExitance / pi, if the eye is in front.
 * - Diffuse: DiffuseReflectance times irradiance / pi. With SeparateSides of the
 *   vtkIrradianceFilter the irradiance of the side that the eye sees counts, else of both
 *   sides together: switch it on for sheets that are lit from both sides.
 * - Specular: the sum over the photons on the cell, on the side that the eye sees, of power times
 *   BRDF over the area. The larger the PhongExponent, the fewer photons a lobe has, and the noisier
 *   the sum; what is smaller than a cell is averaged away. With DirectLight Gathered the samples with which the
 *   cell gathered it count as photons, too.
 * - Mirrors (infinite PhongExponent): what rays see in them, at NumberOfMirrorSamples points of a
 *   cell, through at most 64 further mirrors.
 *
 * What stands between eye and cell is not looked at: a renderer knows what is hidden. So an eye may
 * be anywhere, also inside a body, of whose cells it sees the back. At a cell's own place it sees
 * no direction to the light that comes from there. Cells without area, vertices and lines have 0.
 *
 * While walks are stale (RepairTimeBudget), the radiance rests on them like the irradiance does.
 *
 * @section RadianceErrors Errors
 * Input that is no such output, that is out of date, or a part of one; an eye position that is not
 * finite: one error, and an empty output. Progress and AbortExecute as in vtkIrradianceFilter.
 */

#ifndef vtkOutgoingRadianceFilter_h
#define vtkOutgoingRadianceFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h" // For the camera

#include <memory> // For the internals

class vtkCamera;

class VTKFILTERSIRRADIANCE_EXPORT vtkOutgoingRadianceFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkOutgoingRadianceFilter* New();
  vtkTypeMacro(vtkOutgoingRadianceFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the eye is, in world coordinates; finite. Without effect while there is a camera. Default
   * (0, 0, 0).
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  ///@}

  ///@{
  /**
   * The camera at whose position the eye is; with ParallelProjection the eye is infinitely far
   * away, against its direction of projection. It is kept by reference: when it moves, the filter
   * executes. Null for EyePosition. Default null.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  ///@}

  ///@{
  /**
   * At how many points of a cell that is a mirror a ray looks into it, 1 to 4096. Default 16.
   */
  vtkSetClampMacro(NumberOfMirrorSamples, int, 1, 4096);
  vtkGetMacro(NumberOfMirrorSamples, int);
  ///@}

  /// Includes the camera.
  vtkMTimeType GetMTime() override;

protected:
  vtkOutgoingRadianceFilter();
  ~vtkOutgoingRadianceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;

  double EyePosition[3] = { 0, 0, 0 };
  int NumberOfMirrorSamples = 16;
  vtkSmartPointer<vtkCamera> Camera;

private:
  vtkOutgoingRadianceFilter(const vtkOutgoingRadianceFilter&) = delete;
  void operator=(const vtkOutgoingRadianceFilter&) = delete;

  void Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
