// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIrradianceProbeFilter
 * @brief   irradiance at sensor points on the surfaces of a vtkIrradianceFilter's scene
 *
 * For each sensor the nearest photons are found, among those that vtkIrradianceFilter has stored in
 * the leaf cells of its ray-casting trees. Their power over the area of the surface on which they
 * arrived is the irradiance. So it does not depend on the size of cells.
 *
 * Section 4.1 of Szecsi, Benedek and Szirmay-Kalos, "Accelerating Animation Through Verification of
 * Shooting Walks" (SCCG 2003).
 *
 * @section ProbeInputs Inputs
 * - Port 0: sensors, a vtkPointSet with point normals (the active ones, or else the array
 *   `Normals`). A normal is the direction from which the sensor receives light; its length does not
 *   matter. Sensors lie on surfaces of the scene, or near them.
 * - Port 1, source: the whole output of a vtkIrradianceFilter, or a shallow copy. A filter that did
 *   not keep its photons, as nothing can move, executes again.
 *
 * @section ProbeOutput Output
 * A shallow copy of the sensors with the point arrays
 * - `Irradiance` (double, W/m2, as many components as that of the source): NaN where there is no
 *   surface within the radius that faces as the sensor does, and farther than a million sizes of the
 *   scene away from it, where nothing can be told;
 * - `NumberOfPhotons` (found; fewer than asked for if there are no more within MaximumRadius);
 * - `SearchRadius` (double, m): the distance of the farthest of them. Distances across the sensor's plane
 *   count eight times.
 *
 * With k photons the relative standard error is about 1 / sqrt(k). More photons come from farther
 * away: what is known is the mean over the surface within the SearchRadius, so shadow edges are
 * blurred, and at an edge of a surface across which light changes the mean is one-sided. Photons count, and so does surface, if
 * their side faces within 45.6 degrees of the sensor: not those of the other side of a thin wall, or
 * of a wall that meets at a corner. As only area that is there counts, no light is lost at edges.
 * Which photons are found does not depend on threads or trees, and after an update they are those of
 * a new filter. Documentation/Theory.md, section 5.4.
 *
 * While walks are stale (RepairTimeBudget), the irradiance rests on them.
 *
 * @section ProbeErrors Errors
 * A source that is no such output, that is out of date, or a part of one; sensors without normals; a
 * point or normal that is not finite, or a normal of length 0: one error that names the point, and an
 * empty output. Progress and AbortExecute as in vtkIrradianceFilter.
 */

#ifndef vtkIrradianceProbeFilter_h
#define vtkIrradianceProbeFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPointSetAlgorithm.h"

class vtkMultiBlockDataSet;

class VTKFILTERSIRRADIANCE_EXPORT vtkIrradianceProbeFilter : public vtkPointSetAlgorithm
{
public:
  static vtkIrradianceProbeFilter* New();
  vtkTypeMacro(vtkIrradianceProbeFilter, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene, as in vtkProbeFilter. A connection keeps it up to date.
   */
  void SetSourceConnection(vtkAlgorithmOutput* output);
  void SetSourceData(vtkDataObject* source);
  vtkDataObject* GetSource();
  ///@}

  ///@{
  /**
   * From how many photons the irradiance is estimated, 2 to 1,000,000. Default 50.
   */
  vtkSetClampMacro(NumberOfPhotons, int, 2, 1000000);
  vtkGetMacro(NumberOfPhotons, int);
  ///@}

  ///@{
  /**
   * Photons farther away do not count, m; > 0, may be infinite. Default: infinite.
   */
  vtkSetMacro(MaximumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  /// Asks the source for its photons.
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkIrradianceProbeFilter();
  ~vtkIrradianceProbeFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;

  int NumberOfPhotons = 50;
  double MaximumRadius;

private:
  vtkIrradianceProbeFilter(const vtkIrradianceProbeFilter&) = delete;
  void operator=(const vtkIrradianceProbeFilter&) = delete;

  void Compute(vtkPointSet* sensors, vtkDataObject* source, vtkPointSet* output);
};

#endif
