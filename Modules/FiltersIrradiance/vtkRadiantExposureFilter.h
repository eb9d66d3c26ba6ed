// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiantExposureFilter
 * @brief   radiant exposure (dose) of every cell: irradiance, integrated over time
 *
 * Visits its input, the output of a vtkIrradianceFilter or of what follows it, at a number of times
 * and sums up by the trapezoidal rule: H = sum of w_i E(t_i), w_i = (t_i+1 - t_i-1) / 2; at the
 * ends, the end itself takes the place of the missing neighbour. One execution visits all times:
 * each is an update of what is upstream. By default the times follow from the irradiance.
 * Data that exist only at some times, such as files, are integrated over those, the TIME_STEPS.
 * Documentation/Guide.md, "The dose": an example, and where the standard error comes from.
 *
 * @section ExposureInput Input
 * Any vtkDataSet, or composite data of them, with the cell arrays of vtkIrradianceFilter:
 * `Irradiance` (W/m2, one or three components), or `IrradianceFront` and `IrradianceBack`. It may
 * come from files. Its cells stay the same over time, in number and order; their points may move.
 *
 * Blocks without cells, and empty ones, receive nothing at that time: such is a part while it is
 * away. Between the last time without it and the first with it, half a step of its first irradiance
 * counts.
 *
 * Without TIME_RANGE and TIME_STEPS upstream nothing changes over time; then give StartTime and
 * EndTime.
 *
 * @section ExposureOutput Output
 * Data of the type and structure of the input. Each block is as at the last visited time at which
 * it had cells, with its arrays, except those that were integrated. In their place are the cell
 * arrays
 * - `RadiantExposure`, or `RadiantExposureFront` and `RadiantExposureBack` (double, J/m2);
 * - each with `StandardError` behind its name (J/m2), if the input has standard errors; NaN where
 *   it is not known. The 95 % interval is the exposure +- this times the field `ConfidenceFactor`;
 * - `RadiantExposure_` and the name of the group (`RadiantExposureFront_`...) of each light group of
 *   which the input has irradiance (ComputeLightGroups): without errors, and never spread. A group
 *   that is not there at a time brings nothing then.
 *
 * Field data of the root: the input's at the last time, and `StartTime`, `EndTime` (s),
 * `NumberOfTimeSteps` (intervals between visited times), `IntegrationTimes` (s, one tuple for each
 * visited time). With error control `TimeIntegrationError` (reached, relative, of the worst block)
 * and `TimeIntegrationNoise` (what looked like error but is noise). If the input has the powers of
 * vtkIrradianceFilter at all times, also `EmittedEnergy`, `AbsorbedEnergy`, `EscapedEnergy` (J, per
 * band), and `PowerBalanceError`: the largest |emitted - absorbed - escaped| of any time and band,
 * relative to the emitted power.
 *
 * The output belongs to no time: it does not pass TIME_STEPS on. It is for the piece that is asked
 * for; of a vtkIrradianceFilter, piece 0 has all cells, and others have none.
 *
 * @section ExposureErrors Errors
 * StartTime or EndTime outside of the input's times, or the wrong way round; no TIME_STEPS among
 * them with TimeSteps; no irradiance, or one of points (see the Guide for the dose of sensors); no
 * replicates of it with NumberOfSpreadPhotons; irradiance that is not finite; blocks whose number
 * of cells or whose arrays differ between times; StalePower, which a RepairTimeBudget upstream
 * left; an input with other times than those asked for, as files between their steps, unless
 * IntegrationMode is Automatic and they are its steps: one error that names block, cell, times and
 * values, and an empty output.
 */

#ifndef vtkRadiantExposureFilter_h
#define vtkRadiantExposureFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkSmartPointer.h" // For the controller

#include <memory> // For the internals

class vtkMultiProcessController;

class VTKFILTERSIRRADIANCE_EXPORT vtkRadiantExposureFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkRadiantExposureFilter* New();
  vtkTypeMacro(vtkRadiantExposureFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Which times are visited.
  enum IntegrationModes
  {
    TimeSteps = 0,       ///< StartTime, the input's TIME_STEPS after it, EndTime
    Uniform = 1,         ///< NumberOfTimeSteps equal intervals from StartTime to EndTime
    ErrorControlled = 2, ///< intervals are halved until RelativeTolerance is met
    Automatic = 3 ///< ErrorControlled; TimeSteps if the input exists only at those, as files do
  };

  /// @{
  /**
   * The span of time over which is integrated, s, within the input's TIME_RANGE (or TIME_STEPS, if
   * it has no range). NaN: where that begins or ends. Default NaN.
   */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  vtkSetMacro(EndTime, double);
  vtkGetMacro(EndTime, double);
  /// @}

  /// @{
  /** See IntegrationModes. Default Automatic. */
  vtkSetClampMacro(IntegrationMode, int, TimeSteps, Automatic);
  vtkGetMacro(IntegrationMode, int);
  void SetIntegrationModeToTimeSteps() { this->SetIntegrationMode(TimeSteps); }
  void SetIntegrationModeToUniform() { this->SetIntegrationMode(Uniform); }
  void SetIntegrationModeToErrorControlled() { this->SetIntegrationMode(ErrorControlled); }
  void SetIntegrationModeToAutomatic() { this->SetIntegrationMode(Automatic); }
  /// @}

  /// @{
  /**
   * Number of intervals with Uniform, 1 to 1,000,000; with error control, the first ones are no
   * longer than the span over this. Default 20.
   */
  vtkSetMacro(NumberOfTimeSteps, int);
  vtkGetMacro(NumberOfTimeSteps, int);
  /// @}

  /// @{
  /**
   * With error control, the error of the integration over time that is tolerated on each block: the
   * sum over its cells of area * error, relative to the sum of area * exposure; > 0. It is an
   * estimate, which does not see what is over between two visited times: the first intervals should
   * be no longer than a lamp takes to pass. Default 0.01.
   */
  vtkSetMacro(RelativeTolerance, double);
  vtkGetMacro(RelativeTolerance, double);
  /// @}

  /// @{
  /**
   * With error control, the number of intervals at which halving ends; at least NumberOfTimeSteps.
   * The TIME_STEPS of the input are visited all the same. If it is reached before the tolerance is,
   * a warning names the blocks and their errors. Default 1000.
   */
  vtkSetMacro(MaximumNumberOfTimeSteps, int);
  vtkGetMacro(MaximumNumberOfTimeSteps, int);
  /// @}

  /// @{
  /**
   * On how many photons the dose of a small cell draws, on the average of its block, 1 to
   * 1,000,000; 0: each cell stands for itself. The dose is spread over neighbouring cells of a
   * vtkPolyData, once, at the end, as the part is at its last time with cells; other blocks stay as
   * they are. The noise is about 1 / the root of this, the blur grows with its root, and energy is
   * conserved in each block, up to rounding. A photon that brings light at many times counts once.
   * Gathered direct light is spread as well. Standard errors are the spread dose's, without the
   * blur. It needs replicates (ComputeStandardError of vtkIrradianceFilter). Default 0.
   */
  vtkSetMacro(NumberOfSpreadPhotons, int);
  vtkGetMacro(NumberOfSpreadPhotons, int);
  /// @}

  /// @{
  /**
   * The processes that share the times; null: this one alone. Each has the whole pipeline and
   * computes every n-th time; a vtkIrradianceFilter upstream computes alone then, whatever its
   * Controller. Each has the whole output, with the bits of one process alone; of several pieces,
   * the first has all. All have to update at the same time, with the same input and settings; else,
   * or if one fails or is aborted, each has one error. While intervals are halved, one or two times
   * are known in advance, and other processes wait. As a rule, give the Controller to
   * vtkIrradianceFilter: see "Several processes" in the Guide. Default null.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  /// @}

protected:
  vtkRadiantExposureFilter();
  ~vtkRadiantExposureFilter() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double StartTime;
  double EndTime;
  int IntegrationMode = Automatic;
  int NumberOfTimeSteps = 20;
  double RelativeTolerance = 0.01;
  int MaximumNumberOfTimeSteps = 1000;
  int NumberOfSpreadPhotons = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
