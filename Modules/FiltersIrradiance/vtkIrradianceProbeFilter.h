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
 *   matter. Sensors lie on surfaces of the scene, or nearly: each is moved to the closest point of the
 *   surface that faces as it does, no farther than MaximumDistance. Sensors in the air, such as in
 *   a working plane, cannot be measured: give them a surface, a sheet of reflectance 0 among the inputs,
 *   which then also casts a shadow.
 * - Port 1, source: the whole output of a vtkIrradianceFilter, or a shallow copy. A filter that did
 *   not keep its photons, as nothing can move, executes again.
 *
 * @section ProbeOutput Output
 * A shallow copy of the sensors with the point arrays
 * - `Irradiance` (double, W/m2, as many components as in the source): NaN where there is no
 *   surface within MaximumDistance that faces as the sensor does, and farther than a million sizes of the
 *   scene away from it, where nothing can be told. One warning says how many such sensors there are, and
 *   which is the first;
 * - `NumberOfPhotons` (found; fewer than asked for if there are no more within MaximumRadius, 0 where the
 *   irradiance is NaN);
 * - `SearchRadius` (double, m): the distance of the farthest of them; MaximumRadius if there are fewer,
 *   NaN where the irradiance is. Distances across the sensor's plane count eight times.
 *
 * With k photons the relative standard error is about 1 / sqrt(k). More photons come from farther
 * away: what is known is the mean over the surface within the SearchRadius, so shadow edges are
 * blurred, and at an edge of a surface across which light changes the mean is one-sided. Photons count, and so does surface, if
 * their side faces within 45.6 degrees of the sensor, is not inside of a body, and is of the same surface
 * as far as planes can tell: not the other side of a thin wall, a wall that meets at a corner,
 * the inner face of a thin board, or a sheet or a step above or below. (Where sheets bend, one below
 * another counts beyond sqrt(2 R h), for the radius R of the bend and the distance h of the sheets.) As
 * only area that is there counts, no light is lost at edges.
 * Which photons are found does not depend on threads or trees, and after an update a new filter
 * would find the same. Documentation/Theory.md, section 5.4.
 *
 * With DirectLight Gathered the photons are those of indirect light. What comes straight from the lights is that of
 * the surface at the very point to which the sensor is moved, from 64 rays: it is not blurred, and is added to `Irradiance`. Documentation/Theory.md, section 1.3.
 *
 * While walks are stale (RepairTimeBudget), the irradiance rests on them.
 *
 * @section ProbeTime Time
 * TIME_STEPS and TIME_RANGE unite the times of the source and of the sensors. The requested time goes to
 * both.
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
   * Photons farther away do not count, m; >= 0, may be infinite. With 0, the default, it is four times the
   * radius that NumberOfPhotons photons fill on the average of the scene, but at most a quarter of the
   * scene's largest extent: so dark places do not draw on light from elsewhere, and have fewer photons.
   */
  vtkSetMacro(MaximumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  ///@{
  /**
   * Sensors farther from a surface that faces as they do have no irradiance, m; >= 0, may be infinite.
   * With 0, the default, it is 1/128 of the scene's largest extent (3 cm in a room of 4 m).
   */
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  /// Asks the source for its photons, and unites the times of both inputs.
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkIrradianceProbeFilter();
  ~vtkIrradianceProbeFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;

  int NumberOfPhotons = 50;
  double MaximumRadius = 0;
  double MaximumDistance = 0;

private:
  vtkIrradianceProbeFilter(const vtkIrradianceProbeFilter&) = delete;
  void operator=(const vtkIrradianceProbeFilter&) = delete;

  void Compute(vtkPointSet* sensors, vtkDataObject* source, vtkPointSet* output);
};

#endif
