// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOutgoingRadianceFilter
 * @brief   radiance that leaves the cells of a vtkIrradianceFilter's scene towards an eye
 *
 * Adds what an eye sees of each cell: light that the cell emits, and light that it reflects
 * diffusely and specularly. When the camera moves this filter alone executes.
 *
 * @section RadianceInput Input
 * The whole output of a vtkIrradianceFilter, or a shallow copy.
 *
 * @section RadianceOutput Output
 * A shallow copy of the input with the cell array `Radiance` (double, W/m2/sr, as many components
 * as `Irradiance`): the mean over the area of the cell of the radiance towards the eye. It is
 * active. If the input has standard errors, so has the radiance: `RadianceStandardError`, NaN where
 * it is not known. Emitted light has none.
 * - Emitted: RadiantExitance / pi, if the eye is in front.
 * - Diffuse: DiffuseReflectance times irradiance / pi. With SeparateSides of the
 *   vtkIrradianceFilter the irradiance of the side that the eye sees counts, else of both
 *   sides together: switch it on for sheets that are lit from both sides.
 * - Specular: what rays find that leave NumberOfSpecularSamples points of the cell along the lobe
 *   around the mirrored direction to the eye, or along that direction from a mirror (infinite
 *   PhongExponent). They read the irradiance of large cells where they hit, of the side that they
 *   hit; at small or near ones they ask the lights and go on, also by way of other lobes and
 *   mirrors. Lobes ask the lights as well as their rays; so narrow ones, and small lamps, have
 *   little noise. What is smaller than a cell is averaged away.
 *
 * A mirror cannot see a point light, nor a lobe what a point light sends it by way of a mirror.
 * What stands between eye and cell is not looked at: a renderer knows what is hidden. An eye may be
 * anywhere, also inside a body, of whose cells it sees the back; at a cell's own place it sees no
 * direction to the light from there. Cells without area, vertices and lines have 0. While walks are
 * stale (RepairTimeBudget), the radiance rests on them.
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

  /// @{
  /** Where the eye is in the world, m, unless there is a camera; finite. Default (0, 0, 0). */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /// @}

  /// @{
  /**
   * At whose position the eye is; with ParallelProjection it is infinitely far away, against the
   * direction of projection. When the camera moves, the filter executes. Default null.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /// @}

  /// @{
  /**
   * From how many points of a specular cell a ray looks for what it reflects, 1 to 4096, rounded up
   * to a multiple of the replicates if there are error bars. The noise goes as 1 /
   * sqrt(NumberOfSpecularSamples), or less. Default 16.
   */
  vtkSetClampMacro(NumberOfSpecularSamples, int, 1, 4096);
  vtkGetMacro(NumberOfSpecularSamples, int);
  /// @}

  /// Includes the camera.
  vtkMTimeType GetMTime() override;

protected:
  vtkOutgoingRadianceFilter();
  ~vtkOutgoingRadianceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double EyePosition[3] = { 0, 0, 0 };
  int NumberOfSpecularSamples = 16;
  vtkSmartPointer<vtkCamera> Camera;

private:
  void Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
