// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointIrradianceFilter
 * @brief   irradiance at the points of a vtkIrradianceFilter's scene
 *
 * What vtkIrradianceFilter finds are means over cells. This filter gathers the light at the points
 * of their meshes, so that surfaces are shown smooth: NumberOfRays rays look for the lights from
 * each point, and as many for the indirect light, as those of vtkIrradianceProbeFilter with
 * Estimate Gathered.
 *
 * @section PointInput Input
 * The whole output of a vtkIrradianceFilter, or a shallow copy. What each side of its cells
 * received comes with it, see vtkOutgoingRadianceFilter.
 *
 * A point with an active point normal receives its light on the plane across that. Without normals
 * it has the mean normal of the cells that meet there, weighted by their angles; where these meet
 * at more than FeatureAngle it lies on a crease, and has the mean of what it receives on each of
 * the smooth facets, weighted by the angles that they fill. To show creases sharp, have
 * vtkPolyDataNormals split their points before vtkIrradianceFilter. At an edge of a surface the
 * light is gathered 1e-4 of the cell's width from it, 2^-20 of the scene's size and 2^-32 of its
 * largest coordinate, lamps apart, so that a wall which meets the surface there is beside the
 * point.
 *
 * @section PointOutput Output
 * A shallow copy of the input with the point array `PointIrradiance` (double, W/m2, as many
 * components as `Irradiance`): that of both sides together, as `Irradiance`. It is active. With
 * SeparateSides of the vtkIrradianceFilter there are `PointIrradianceFront` and
 * `PointIrradianceBack` in its place. If the input has standard errors, each array has its own:
 * `PointIrradianceStandardError`, from replicates, NaN where nothing arrived. Points without
 * polygons have NaN.
 *
 * The samples follow from the seed of the source and the place of the point among all, so after an
 * update the result is that of a new filter, bit for bit. After motions only rays are cast again
 * that these may change. Rays read means over the cells that they hit, a bias that shrinks with
 * these. With DistributedInput each process gathers for the points of its own pieces: the noise,
 * and mean normals at their borders, depend on the division. While walks are stale
 * (RepairTimeBudget), the light rests on them. Documentation/Theory.md, section 5.8.
 *
 * @section PointErrors Errors
 * Input that is no such output, that is out of date, or a part of one; a point light beside cells
 * with a SpecularReflectance: one error, and an empty output. Progress and AbortExecute as in
 * vtkIrradianceFilter.
 */

#ifndef vtkPointIrradianceFilter_h
#define vtkPointIrradianceFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <memory> // For the internals

class VTKFILTERSIRRADIANCE_EXPORT vtkPointIrradianceFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkPointIrradianceFilter* New();
  vtkTypeMacro(vtkPointIrradianceFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// @{
  /**
   * How many rays look for indirect light at each side of a point, and how many for the lights, 1
   * to 1,000,000; rounded up to a multiple of the source's replicates. The noise falls with the
   * root of the number, or faster; the time grows with it. Default 64.
   */
  vtkSetClampMacro(NumberOfRays, int, 1, 1000000);
  vtkGetMacro(NumberOfRays, int);
  /// @}

  /// @{
  /**
   * Cells that meet at a larger angle meet in a crease, degrees, 0 to 180. Without effect on points
   * that have normals. Default 30.
   */
  vtkSetClampMacro(FeatureAngle, double, 0, 180);
  vtkGetMacro(FeatureAngle, double);
  /// @}

  /// Old: nothing depends on it; one warning says so. Rays are kept where memory allows it.
  void SetKeepRays(bool);
  void KeepRaysOn() { this->SetKeepRays(true); }
  void KeepRaysOff() { this->SetKeepRays(false); }

protected:
  vtkPointIrradianceFilter();
  ~vtkPointIrradianceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int NumberOfRays = 64;
  double FeatureAngle = 30;

private:
  void Compute(vtkMultiBlockDataSet* input, vtkMultiBlockDataSet* output);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
