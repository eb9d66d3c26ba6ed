// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiantExposureFilter
 * @brief   radiant exposure (dose) of every cell: irradiance, integrated over time
 *
 * Visits its input, the output of a vtkIrradianceFilter or of what follows it, at a number of times
 * and sums up
 *
 *   H = sum of w_i E(t_i),  w_i = (t_i+1 - t_i-1) / 2,
 *
 * which is the trapezoidal rule; at the ends, the end itself takes the place of the missing
 * neighbour. One execution visits all times: each is an update of what is upstream.
 *
 * By default the times follow from the irradiance, see "Error control". Data that exist only at some times, such as
 * files, are integrated over those, the TIME_STEPS.
 *
 * @section ExposureInput Input
 * Any vtkDataSet, or composite data of them, with the cell arrays of vtkIrradianceFilter:
 * `Irradiance` (W/m2, one or three components), or `IrradianceFront` and `IrradianceBack`. It may
 * come from files. Its cells stay the same over time, in number and order; their points may move.
 *
 * Blocks without cells, and empty ones, receive nothing at that time: a part that appears or leaves
 * is one without cells while it is away. Between the last time without a part and the first with it,
 * the trapezoidal rule counts half a step of its first irradiance.
 *
 * The input has some times alone if it, or anything upstream of it, comes with another DATA_TIME_STEP than
 * was asked for, as readers of files do. Automatic finds out by asking first for a time between two steps.
 * So if one part of a scene comes from files, all of it is integrated over the TIME_STEPS of all parts; if those
 * are too few for the other parts, choose Uniform or ErrorControlled.
 *
 * Without TIME_RANGE and TIME_STEPS upstream nothing changes over time; then give StartTime and EndTime.
 *
 * @section ExposureOutput Output
 * Data of the type and structure of the input. Each block is that of the last visited time at which
 * it had cells, with its arrays, except those that were integrated. In their place are the cell arrays
 * - `RadiantExposure`, or `RadiantExposureFront` and `RadiantExposureBack` (double, J/m2);
 * - `RadiantExposureStandardError`, or `RadiantExposureFrontStandardError` and
 *   `RadiantExposureBackStandardError` (J/m2), if the input has standard errors, see below.
 *
 * Field data of the root: those of the last time, and `StartTime`, `EndTime` (s), `NumberOfTimeSteps`
 * (intervals between visited times), `IntegrationTimes` (s, one tuple for each visited time). With error control
 * `TimeIntegrationError` and `TimeIntegrationNoise`, see there. If the
 * input has the powers of vtkIrradianceFilter at all times, also `EmittedEnergy`, `AbsorbedEnergy`,
 * `EscapedEnergy` (J, per band), and `PowerBalanceError`: the largest |emitted - absorbed - escaped|
 * of any time and band, relative to the emitted power.
 *
 * The output belongs to no time: it does not pass TIME_STEPS on. It is that of the piece that is asked
 * for; of a vtkIrradianceFilter, piece 0 has all cells, and others have none.
 *
 * @section Error The standard error
 * Irradiances of different times come from the same walks, so their errors do not average out as those
 * of independent measurements do: their squares may not be added. With a vtkIrradianceFilter upstream
 * whose ComputeStandardError is on, this filter asks it for the irradiance of each replicate (8 bytes for
 * each cell, band, side and replicate, as long as it runs). The exposures of the replicates are
 * independent, and the standard error comes from their scatter. The 95 % interval is the exposure +-
 * this times `ConfidenceFactor` (field data, that of the irradiance filter).
 *
 * It is NaN where it is not known: without an area, and where too few photons arrived over the whole
 * span; it may be known where that of the irradiance never is. It tells the noise of the photons, not the
 * error of the integration over time. Documentation/Theory.md, section 5.5.
 *
 * Input with standard errors but without replicates, such as files: the sum of w_i times the standard
 * error at t_i, an upper bound, which holds however errors depend on each other; NaN if the error is not
 * known at one of the times.
 *
 * @section Control Error control
 * ErrorControlled begins with all TIME_STEPS of the input within the span, and with equal parts of what would be
 * longer than the span over NumberOfTimeSteps. The intervals between these times are taken in pairs. On every
 * block, the error of a pair is the difference between its two trapezoids and a single one over both, summed
 * up with the areas of cells (times the ratio of the two lengths, if they differ). The worst pair is halved,
 * both intervals in their middles, until on every block the errors of all pairs add up to at most
 * RelativeTolerance of the exposure.
 *
 * Where irradiance is smooth over time this is about 3 times the error; at a jump, such as a part that appears,
 * it bounds the error. It is an estimate nevertheless: what happens between the times that were visited, and
 * is over at the next, is not seen. So an interval of the first ones should be no longer than a lamp
 * takes to pass.
 *
 * What is integrated is the irradiance as the filter upstream estimates it. As things move, single photons
 * come and go, and to follow them gains nothing. The input says how much one photon is, if a vtkIrradianceFilter is
 * upstream. Then only that part of a difference counts as error that exceeds 3 standard deviations of what
 * photons would do that arrive by chance, in single cells or in sums over neighbours. The rest is noise.
 *
 * The field data `TimeIntegrationError` is the error that was reached, relative, of the worst block, and
 * `TimeIntegrationNoise` is what looked like error but is noise, of the noisiest block. If that is large, more
 * walks bring more than more times. The same input leads to the same times.
 *
 * The sum is added up by halves: for each final pair w_i E(t_i) in the order of time, then both halves of
 * what was halved; and from the pairs of the first times on, of a range of n pairs, the first n/2 (rounded down)
 * and the others. Pairs that need no halving are added up at once, and so are not kept in memory. With TimeSteps and
 * Uniform all is added up in the order of time. Documentation/Theory.md, section 5.6.
 *
 * @section Abort Progress, abort, and continuing
 * Progress is reported after each time; that of the updates themselves is upstream's own. Aborting this
 * filter ends the run after the update that is going on; aborting a filter upstream, such as the
 * vtkIrradianceFilter, ends both at once. The output is empty then and, as with all VTK filters, up to date
 * until Modified(). The next execution continues behind the last time that was finished, if neither the
 * properties nor anything upstream was modified since; else it starts again. The result is the same, to
 * the bit.
 *
 * @section ExposureErrors Errors
 * StartTime or EndTime outside of the input's times, or the wrong way round; no TIME_STEPS among them
 * with TimeSteps; no irradiance; irradiance that is not finite; blocks whose number of cells or whose arrays
 * differ between times; StalePower (a RepairTimeBudget upstream left walks that are no longer valid, and
 * what rests on them is not what the scene receives); an input that has other times than those asked
 * for, as files between their steps, unless IntegrationMode is Automatic and they are its steps: one error that names block, cell, times and values, and an empty
 * output.
 */

#ifndef vtkRadiantExposureFilter_h
#define vtkRadiantExposureFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // For the internals

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
    ErrorControlled = 2, ///< as RelativeTolerance needs it, see "Error control"
    Automatic =
      3 ///< ErrorControlled; TimeSteps if the input exists only at its TIME_STEPS, as files do
  };

  ///@{
  /**
   * The span of time over which is integrated, s, within the input's TIME_RANGE (or TIME_STEPS, if it
   * has no range). NaN: where that begins or ends. Default NaN.
   */
  vtkSetMacro(StartTime, double);
  vtkGetMacro(StartTime, double);
  vtkSetMacro(EndTime, double);
  vtkGetMacro(EndTime, double);
  ///@}

  ///@{
  /**
   * See IntegrationModes. Default Automatic.
   */
  vtkSetClampMacro(IntegrationMode, int, TimeSteps, Automatic);
  vtkGetMacro(IntegrationMode, int);
  void SetIntegrationModeToTimeSteps() { this->SetIntegrationMode(TimeSteps); }
  void SetIntegrationModeToUniform() { this->SetIntegrationMode(Uniform); }
  void SetIntegrationModeToErrorControlled() { this->SetIntegrationMode(ErrorControlled); }
  void SetIntegrationModeToAutomatic() { this->SetIntegrationMode(Automatic); }
  ///@}

  ///@{
  /**
   * Number of intervals with Uniform, 1 to 1,000,000; with error control, the span over this is the length
   * of the longest that it begins with. Default 20.
   */
  vtkSetMacro(NumberOfTimeSteps, int);
  vtkGetMacro(NumberOfTimeSteps, int);
  ///@}

  ///@{
  /**
   * With error control, the error of the integration over time that is tolerated on each block: the sum
   * over its cells of area * error, relative to that of area * exposure; > 0. See "Error control" above.
   * Default 0.01.
   */
  vtkSetMacro(RelativeTolerance, double);
  vtkGetMacro(RelativeTolerance, double);
  ///@}

  ///@{
  /**
   * With error control, the number of intervals at which halving ends; at least NumberOfTimeSteps. The
   * TIME_STEPS of the input are visited all the same. If it is reached before the tolerance is, a warning
   * names the blocks and their errors. Default 1000.
   */
  vtkSetMacro(MaximumNumberOfTimeSteps, int);
  vtkGetMacro(MaximumNumberOfTimeSteps, int);
  ///@}

protected:
  vtkRadiantExposureFilter();
  ~vtkRadiantExposureFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;

  double StartTime;
  double EndTime;
  int IntegrationMode = Automatic;
  int NumberOfTimeSteps = 20;
  double RelativeTolerance = 0.01;
  int MaximumNumberOfTimeSteps = 1000;

private:
  vtkRadiantExposureFilter(const vtkRadiantExposureFilter&) = delete;
  void operator=(const vtkRadiantExposureFilter&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
