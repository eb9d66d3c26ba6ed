// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIrradianceProbeFilter
 * @brief   irradiance or fluence rate at sensor points in a vtkIrradianceFilter's scene
 *
 * Two estimates:
 * - `Gathered`: for sensors anywhere, on surfaces or in the air. NumberOfRays rays ask the lights
 *   at the very point; as many look for the indirect light, and read what large cells received.
 *   Nothing is blurred over the surroundings of a sensor.
 * - `Nearest`: for sensors on surfaces. The power of the nearest photons that vtkIrradianceFilter
 *   has stored, over the area of the surface on which they arrived, is the irradiance. Section 4.1
 *   of Szecsi, Benedek and Szirmay-Kalos, "Accelerating Animation Through Verification of Shooting
 *   Walks" (SCCG 2003).
 *
 * Neither depends on the size of the cell on which a sensor stands.
 *
 * @section ProbeInputs Inputs
 * - Port 0: sensors, the points of any vtkDataSet; a volume of vtkImageData, too. Point normals
 *   (the active ones, or else the array `Normals`) are the directions from which sensors receive
 *   light; their length does not matter. Nearest needs them. Without them Gathered finds the
 *   fluence rate. With Nearest sensors lie on surfaces of the scene, or nearly: each is moved to
 *   the closest point of the surface that faces as it does, no farther than MaximumDistance. With
 *   Gathered a sensor is taken 2^-20 of the scene's size (4 um of 4 m) and 2^-32 of its largest
 *   coordinate, lamps apart, along its normal, or without normals towards the middle of the scene:
 *   rounding does not put it behind its own surface, nor the rim of a grid out of its room. Move it
 *   as the surfaces move. On a face that touches a lamp it comes to be behind the lamp's face and
 *   finds 0; Nearest knows what the lamp emits there.
 * - Port 1, source: the whole output of a vtkIrradianceFilter, or a shallow copy. Nearest reads
 *   photons: a filter that did not keep them, as nothing can move, executes again, once.
 *
 * @section ProbeOutput Output
 * A copy of the sensors, of the same type, that shares their arrays, with point arrays.
 *
 * With Nearest
 * - `Irradiance` (double, W/m2, as many components as in the source): NaN where there is no surface
 *   within MaximumDistance that faces as the sensor does, and farther than a million sizes of the
 *   scene away from it. One warning says how many such sensors there are, and which is the first;
 * - `NumberOfPhotons` (found; fewer than asked for if there are no more within MaximumRadius, 0
 *   where the irradiance is NaN);
 * - `SearchRadius` (double, m): the distance of the farthest of them; MaximumRadius if there are
 *   fewer, NaN where the irradiance is. Of several light groups both are the largest. Distances across the sensor's plane count eight times.
 *
 * With Gathered
 * - `Irradiance` (double, W/m2, likewise) on the plane across the normal: NaN only farther than a
 *   million sizes of the scene away, with a warning; 0 inside of closed bodies;
 * - without normals instead `FluenceRate` (double, W/m2), also known as scalar irradiance: the
 *   integral of the radiance over the sphere; of a beam it is the irradiance on a plane across it,
 *   where all directions are alike four times the irradiance of a plane;
 * - `IrradianceStandardError` or `FluenceRateStandardError` (double, W/m2) where the source has
 *   standard errors (ComputeStandardError): from its replicates, each with rays of its own that
 *   read its own sums. NaN where nothing arrived; the field `NumberOfUnknownErrors` counts these.
 *   What reading means over cells biases is not in it;
 * - each with `_` and the name of a light group behind `Irradiance` or `FluenceRate`, of what that
 *   group brings, where the source has such arrays (ComputeLightGroups).
 *
 * @section ProbeNearest Nearest
 * With k photons the relative standard error is about 1 / sqrt(k). What is known is the mean over
 * the surface within the SearchRadius, so shadow edges are blurred, and at an edge of a surface
 * across which light changes the mean is one-sided. Photons and surface count if their side faces
 * within 45.6 degrees of the sensor, is not inside of a body, and is of the same surface as far as
 * planes can tell: not the other side of a thin wall, a wall that meets at a corner, the inner face
 * of a thin board, or a sheet or a step above or below. (Where sheets bend, one below another
 * counts beyond sqrt(2 R h), for the radius R of the bend and the distance h of the sheets.) Only
 * area that is there counts, so no light is lost at edges. After an update a new filter would find
 * the same photons. Documentation/Theory.md, section 5.4.
 *
 * Where direct light is gathered the photons are those of indirect light. Direct light is asked for
 * at the point to which the sensor is moved, by 64 rays, and added to `Irradiance`, not blurred.
 * Documentation/Theory.md, section 1.3.
 *
 * @section ProbeGathered Gathered
 * Rays that hit a cell which expects 25 photons or more, and is farther than wide, read what its
 * side received; elsewhere they ask the lights and go on. So light that changes within such a cell
 * is read as its mean, a bias that shrinks with the cells. The samples follow from the seed of the
 * source and the number of the point: the result is the same on any threads, and after an update
 * that of a new filter, bit for bit. After motions in the source only the rays are cast again that
 * these may change, and all read the present sums; sensors that change gather anew; after any other
 * change all do. A point light beside cells with a SpecularReflectance is an error.
 * Documentation/Theory.md, section 5.8.
 *
 * @section ProbeTime Time
 * TIME_STEPS and TIME_RANGE unite the times of the source and of the sensors. The requested time
 * goes to both. While walks are stale (RepairTimeBudget), both estimates rest on them.
 *
 * @section ProbeErrors Errors
 * A source that is no such output, that is out of date, or a part of one; with Nearest sensors
 * without normals; a point or normal that is not finite, or a normal of length 0: one error that
 * names the point, and an empty output. Progress and AbortExecute as in vtkIrradianceFilter.
 */

#ifndef vtkIrradianceProbeFilter_h
#define vtkIrradianceProbeFilter_h

#include "vtkDataSetAlgorithm.h"
#include "vtkFiltersIrradianceModule.h" // For export macro

#include <memory>

class vtkDataSet;

class VTKFILTERSIRRADIANCE_EXPORT vtkIrradianceProbeFilter : public vtkDataSetAlgorithm
{
public:
  static vtkIrradianceProbeFilter* New();
  vtkTypeMacro(vtkIrradianceProbeFilter, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// From what the light at a sensor is estimated.
  enum Estimates
  {
    Nearest = 0, ///< the nearest photons on the surface on which it stands
    Gathered = 1 ///< rays to the lights, and others that read what the cells they hit received
  };

  /// @{
  /** The scene, as in vtkProbeFilter. A connection keeps it up to date. */
  void SetSourceConnection(vtkAlgorithmOutput* output);
  void SetSourceData(vtkDataObject* source);
  vtkDataObject* GetSource();
  /// @}

  /// @{
  /** See Estimates. Default Gathered: in the same time it has less noise, and less blur. */
  vtkSetClampMacro(Estimate, int, Nearest, Gathered);
  vtkGetMacro(Estimate, int);
  void SetEstimateToNearest() { this->SetEstimate(Nearest); }
  void SetEstimateToGathered() { this->SetEstimate(Gathered); }
  /// @}

  /// @{
  /**
   * With Gathered, how many rays look for indirect light at each sensor, and how many for the
   * lights, 1 to 1,000,000; rounded up to a multiple of the source's replicates. The noise falls
   * with the root of the number, or faster; the time grows with it. Default 64.
   */
  vtkSetClampMacro(NumberOfRays, int, 1, 1000000);
  vtkGetMacro(NumberOfRays, int);
  /// @}

  /// Old: nothing depends on it; one warning says so. Rays are kept where memory allows it.
  void SetKeepRays(bool);
  void KeepRaysOn() { this->SetKeepRays(true); }
  void KeepRaysOff() { this->SetKeepRays(false); }

  /// @{
  /** With Nearest, from how many photons irradiance is estimated, 2 to 1,000,000. Default 50. */
  vtkSetClampMacro(NumberOfPhotons, int, 2, 1000000);
  vtkGetMacro(NumberOfPhotons, int);
  /// @}

  /// @{
  /**
   * With Nearest, photons farther away do not count, m; >= 0, may be infinite. With 0, the default,
   * it is four times the radius that NumberOfPhotons photons fill on the average of the scene, but
   * at most a quarter of the scene's largest extent: dark places draw on no light from elsewhere.
   */
  vtkSetMacro(MaximumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  /// @}

  /// @{
  /**
   * With Nearest, sensors farther from a surface that faces as they do have no irradiance, m; >= 0,
   * may be infinite. With 0, the default, it is 1/128 of the scene's largest extent (3 cm in a room
   * of 4 m).
   */
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  /// @}

  /// Asks the source for what it has to keep, and unites the times of both inputs.
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkIrradianceProbeFilter();
  ~vtkIrradianceProbeFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Estimate = Gathered;
  int NumberOfRays = 64;
  int NumberOfPhotons = 50;
  double MaximumRadius = 0;
  double MaximumDistance = 0;

private:
  class vtkInternals;

  void Compute(vtkDataSet* sensors, vtkDataObject* source, vtkDataSet* output);

  std::unique_ptr<vtkInternals> Internals;
};

#endif
