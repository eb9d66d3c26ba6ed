// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIrradianceFilter
 * @brief   irradiance of every cell of a scene in which things move
 *
 * Shoots photon walks from the lights and stores them if something may move. Each further update
 * repairs only the walks that a motion changed. The result equals a new filter's on the same input,
 * bit for bit, for any number of threads, any traversal mode, with and without the cache (but see
 * RepairTimeBudget).
 * After Szecsi, Benedek and Szirmay-Kalos, "Accelerating Animation Through Verification of Shooting
 * Walks" (SCCG 2003). Documentation/Guide.md tells more of all that follows.
 *
 * @code
 * vtkNew<vtkIrradianceFilter> irradiance;
 * irradiance->AddInputConnection(0, room->GetOutputPort()); // what stays: walls, lamps
 * irradiance->AddInputDataObject(0, lamp);                  // cell array "RadiantExitance", W/m2
 * irradiance->AddInputConnection(1, ball->GetOutputPort()); // what moves, in model coordinates
 * irradiance->SetDynamicTransform(0, worldFromBall);
 * irradiance->Update(); // repairs what the motion touched
 * auto* output = irradiance->GetOutput(); // "Static", "Dynamic": cell array "Irradiance"
 * @endcode
 *
 * @section Inputs
 * Port 0 takes what stays, port 1 what moves, each any number of vtkPolyData, or composite data of
 * them. Polygons and triangle strips are surfaces, thin or of bodies, whose front is the side from which
 * points run counter-clockwise; vertex cells with a flux are point lights. Where a pose mirrors
 * (its determinant is negative), the front is the mirror image of the front, as in glTF; the cells
 * of the output keep their own order of points. All lengths are metres. Cell arrays have one
 * component, or three for three bands. SetInputArrayToProcess(index, ...) chooses others:
 * | index | default name         | meaning                                        |
 * |-------|----------------------|------------------------------------------------|
 * | 0     | RadiantExitance      | W/m2 emitted from the front, diffuse; >= 0     |
 * | 1     | DiffuseReflectance   | 0..1, both sides; absent: DefaultDiffuseReflectance |
 * | 2     | SpecularReflectance  | 0..1, both sides; absent: 0                    |
 * | 3     | PhongExponent        | >= 0, one component; infinite or absent: mirror |
 * | 4     | RadiantFlux          | W of a vertex cell; >= 0                       |
 * | 5     | DiffuseTransmittance | 0..1, diffusely to the other side; absent: 0    |
 * | 6     | SpecularTransmittance | 0..1, straight through; absent: 0             |
 * | 7     | RefractiveIndex      | >= 1, one component; above 1: a clear pane      |
 * | 8     | InternalTransmittance | of panes, in (0, 1], one passage straight through; absent: 1 |
 * 1, 2, 5 and 6 add up to at most 1. A pane needs none of these: what it reflects and lets through
 * follows by angle (Fresnel). Light goes on as it came: no body refracts.
 *
 * @section Output
 * Port 0: vtkMultiBlockDataSet with the blocks `Static` and `Dynamic`, each with one vtkPolyData
 * per connection, in order, in world coordinates. Added are the cell array `Irradiance` (double,
 * W/m2), arrays of the properties below, and field data with the figures of the update. Input that
 * cannot be computed is one error that names the input, the cell and the value, and an empty
 * output. What is hardly meant is a warning.
 *
 * Progress is reported and AbortExecute honoured within 0.1 s. Runs on VTK's threads (vtkSMPTools),
 * and on the processes of the Controller. If they ask for pieces, the first has the whole result,
 * unless DistributedInput.
 */

#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h" // For the controller

#include <memory> // For the internals

class vtkLinearTransform;
class vtkMultiProcessController;
class vtkPolyData;
class vtkTransformInterpolator;

class VTKFILTERSIRRADIANCE_EXPORT vtkIrradianceFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkIrradianceFilter* New();
  vtkTypeMacro(vtkIrradianceFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How light becomes known. "Which method" in the Guide shows what each is good for.
  enum Methods
  {
    Automatic = 0,   ///< Gathered, Walks or SpreadWalks, or what is between, as suits the scene
    Walks = 1,       ///< walks start at the lights, and a cell has the photons that arrived in it
    SpreadWalks = 2, ///< likewise, but small cells also have a part of the photons around them
    Gathered = 3,    ///< each cell looks for the lights, and small cells cast rays for indirect
                     ///< light, which read what walks brought to the cells that they hit
    GatheredEverywhere = 4, ///< likewise, but all cells cast rays
    PathTraced = 5          ///< as Gathered, but rays read nothing: they go on, and ask the lights
                            ///< wherever they hit
  };

  /// @{
  /**
   * Pose (model to world) of the i-th connection of port 1, an invertible affine map; null: the
   * field-data array `ObjectToWorld` (16 values, row by row) of the input, or else the identity. A
   * leaf of composite data with an `ObjectToWorld` is moved by that first. It is kept by reference:
   * changing it makes the filter execute, even during a run. After removing a connection, set the
   * transforms again.
   */
  void SetDynamicTransform(int i, vtkLinearTransform* worldFromObject);
  vtkLinearTransform* GetDynamicTransform(int i);
  /// @}

  /// Removes all dynamic transforms.
  void RemoveAllDynamicTransforms();

  /// @{
  /** SetDynamicTransform by 16 values, row by row, with (0, 0, 0, 1) in the last row. */
  void SetDynamicMatrix(int i, double m00, double m01, double m02, double m03, double m10,
    double m11, double m12, double m13, double m20, double m21, double m22, double m23, double m30,
    double m31, double m32, double m33);
  void SetDynamicMatrix(int i, const double elements[16]);
  /// @}

  /// Removes the inputs of port 1; the poses stay.
  void RemoveAllDynamicInputs() { this->RemoveAllInputConnections(1); }

  /// From which cell array a quantity is read. `quantity`: a default name of the table above, such
  /// as "DiffuseReflectance"; another is an error. `name`: empty, null or "None": from none.
  void SetCellArray(const char* quantity, const char* name);

  /// @{
  /**
   * Walks and PathTraced are without bias. SpreadWalks trades noise for blur. Rays of Gathered and
   * GatheredEverywhere take the cells that they hit for evenly lit, a bias of about a percent that
   * shrinks with these cells. The fields `DirectLight` (0 shot, 1 gathered) and `CellEstimate`
   * (0 sums, 1 spread, 3 rays) say what Automatic chose.
   *
   * With the three last methods, and where Automatic gathers, `EmittedPower` is that of the lights
   * and equals `AbsorbedPower` + `EscapedPower`, but how these divide is an estimate: in a closed
   * scene `EscapedPower` is zero only within the field `EscapedPowerStandardError`, and may be
   * negative. Where a cell takes fewer than 64 samples for its direct light, intervals are a little
   * too wide (98 to 99 % of them hold the truth). A point light beside cells with a
   * SpecularReflectance is an error with these three. Default Automatic.
   */
  void SetMethod(int method);
  int GetMethod(); ///< -1 if old names were set that are no method together
  void SetMethodToAutomatic() { this->SetMethod(Automatic); }
  void SetMethodToWalks() { this->SetMethod(Walks); }
  void SetMethodToSpreadWalks() { this->SetMethod(SpreadWalks); }
  void SetMethodToGathered() { this->SetMethod(Gathered); }
  void SetMethodToGatheredEverywhere() { this->SetMethod(GatheredEverywhere); }
  void SetMethodToPathTraced() { this->SetMethod(PathTraced); }
  /// @}

  /// @{
  /**
   * Number of photon walks, 1 to 4,294,967,295; at least NumberOfReplicates with error bars. The
   * error of a cell falls with about its square root. Default 1,000,000.
   */
  vtkSetMacro(NumberOfWalks, vtkIdType);
  vtkGetMacro(NumberOfWalks, vtkIdType);
  /// @}

  /// @{
  /**
   * How many rays look for the indirect light of each side of a small cell where cells cast rays, 1
   * to 4096; with error bars rounded up to a multiple of NumberOfReplicates. A cell is small if it
   * would receive fewer than two photons for each ray when NumberOfWalks walks arrived evenly over
   * all area; with GatheredEverywhere a large one casts four times as many. Each cell gathers its
   * direct light with half as many samples at least, or 8. The noise falls with the root of the
   * number, or faster. Default 32.
   */
  vtkSetMacro(NumberOfRays, int);
  vtkGetMacro(NumberOfRays, int);
  /// @}

  /// @{
  /**
   * 0 to 1; 5 % is 0.05. If positive, NumberOfWalks are shot first, and their number is doubled
   * until the half-width of the 95 % interval is at most this times the irradiance on 95 % of the
   * area; where cells cast rays, NumberOfRays likewise, whichever promises more for its time. If
   * MaximumEffort is too little for that, a warning says what was reached. A cell that has received
   * nothing meets the target if 3 more photons would make it no brighter than this times the
   * average; a cell with too few photons does not. 0, the default: no target.
   */
  vtkSetMacro(TargetRelativeError, double);
  vtkGetMacro(TargetRelativeError, double);
  /// @}

  /// @{
  /**
   * With a TargetRelativeError, how many times NumberOfWalks, and NumberOfRays, there may be at
   * most; 1 or more, or 0: up to 10,000,000 walks and 1024 rays. If something may move, walks are
   * stored: one band takes 30 bytes for each segment and 30 for each walk, some 46 a segment in a
   * room that reflects half; after motions, which leave holes, up to 1.7 times that (see
   * `HistoryBytes`). Paths of rays take 32 bytes a segment and 24 a path. Default 0.
   */
  vtkSetMacro(MaximumEffort, double);
  vtkGetMacro(MaximumEffort, double);
  /// @}

  /// @{
  /**
   * Whether the standard error of the irradiance is estimated: the cell array
   * `IrradianceStandardError` (`IrradianceFrontStandardError`, `IrradianceBackStandardError`;
   * W/m2). The 95 % interval is the irradiance +- this times the field `ConfidenceFactor`. It is
   * NaN where it is not known: without an area, and where too few photons arrived. Walks are
   * assigned to NumberOfReplicates replicates with samples of their own. Costs 8 bytes for each
   * cell, band, side and replicate, with a target times the rounds of walks. Default off.
   */
  vtkSetMacro(ComputeStandardError, vtkTypeBool);
  vtkGetMacro(ComputeStandardError, vtkTypeBool);
  vtkBooleanMacro(ComputeStandardError, vtkTypeBool);
  /// @}

  /// @{
  /**
   * Whether each side of a cell has an array: `IrradianceFront` and `IrradianceBack` in place of
   * `Irradiance`, which adds up both. Default off.
   */
  vtkSetMacro(SeparateSides, vtkTypeBool);
  vtkGetMacro(SeparateSides, vtkTypeBool);
  vtkBooleanMacro(SeparateSides, vtkTypeBool);
  /// @}

  /// @{
  /**
   * By how much the lamps of a light group shine: all that they emit, in each band, is multiplied by
   * this; finite, >= 0, 1 if nobody sets it. No walk and no ray is shot for that; a group that is
   * off (0) takes no time. A lamp is in the group that the cell array `LightGroup` (texts or whole
   * numbers) names, or the field-data array `LightGroup` of its input; else all lamps of port 0 are
   * in "Static", and those of connection i of port 1 in "Dynamic i". The field-data array
   * `LightGroupFactor` of an input does the same as this, over time, and multiplies it. Each group
   * has NumberOfWalks walks and rays of its own.
   */
  void SetLightGroupFactor(const char* group, double factor)
  {
    this->SetLightGroupFactor(group, factor, factor, factor);
  }
  void SetLightGroupFactor(const char* group, double first, double second, double third);
  double GetLightGroupFactor(const char* group, int band = 0);
  void RemoveAllLightGroupFactors();
  /// @}

  /// @{
  /**
   * Other walks and rays for one light group: it is computed with this seed in place of Seed. Only
   * this group is shot again; the light of all others stays.
   */
  void SetLightGroupSeed(const char* group, int seed);
  int GetLightGroupSeed(const char* group);
  void RemoveAllLightGroupSeeds();
  /// @}

  /// @{
  /**
   * Whether what each light group brings is an array of its own, `Irradiance_` and the name of the
   * group (`IrradianceFront_`..., with ComputeStandardError their errors). These add up to
   * `Irradiance`, in the order of the names, which the field `LightGroups` tells, with the factors
   * in `LightGroupFactors`. Default off.
   */
  vtkSetMacro(ComputeLightGroups, vtkTypeBool);
  vtkGetMacro(ComputeLightGroups, vtkTypeBool);
  vtkBooleanMacro(ComputeLightGroups, vtkTypeBool);
  /// @}

  /// @{
  /**
   * Seconds that the repair of an update may take; 0, the default: no limit. Verification does not
   * count, nor does shooting if UpdateMode is Rebuild or everything has to be shot again. What is
   * left is repaired by the next executions: without motion call Modified() and Update() until
   * GetFigure("StalePower") is 0. Until then the cell array `StaleIrradiance`
   * (`StaleIrradianceFront`, `StaleIrradianceBack`; W/m2) is the part of the irradiance that rests
   * on walks that are no longer valid, and the field `StaleGainBound` (W) is the most that the full
   * update can bring to all cells together. See "A time budget" in the Guide.
   */
  vtkSetMacro(RepairTimeBudget, double);
  vtkGetMacro(RepairTimeBudget, double);
  /// @}

  /// @{
  /**
   * The diffuse reflectance, 0..1, of inputs without such an array (default 0.5). The seed of the
   * random scrambling of the samples: two seeds give independent results (default 1).
   */
  vtkSetMacro(DefaultDiffuseReflectance, double);
  vtkGetMacro(DefaultDiffuseReflectance, double);
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  /// @}

  /// @{
  /**
   * The processes that share the walks; null: this one alone. Each has the whole scene, shoots and
   * stores its part of the walks, and has the whole output, with the bits of one process alone. All
   * have to update at the same time, with the same inputs and settings; else, or if one fails, each
   * has one error. HistoryBytes and the seconds are this process's own. Where single photons are
   * read (vtkPhotonWalksFilter, vtkIrradianceProbeFilter with Estimate Nearest) each shoots and
   * stores all walks, which excludes a RepairTimeBudget. See "Several processes" in the Guide.
   * Default: VTK's global controller when the filter is made: for most programs this process alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  /// @}

  /// A figure of the output's field data, such as "EmittedPower", summed over bands; W, seconds,
  /// bytes; NaN where there is none.
  double GetFigure(const char* name);

  /// @name Advanced
  /// @{

  /// How rays search the static and the dynamic geometry; the result is the same.
  enum TraversalModes
  {
    OneTree = 0,    ///< one tree over all triangles, rebuilt whenever something moves
    Sequential = 1, ///< the dynamic trees, then the static one up to the hit found
    Parallel = 2    ///< likewise, but beside many or flattened objects the static tree first, then
                    ///< what is before its hit
  };

  /// @{
  /** See TraversalModes. Default Parallel. */
  vtkSetClampMacro(TraversalMode, int, OneTree, Parallel);
  vtkGetMacro(TraversalMode, int);
  void SetTraversalModeToOneTree() { this->SetTraversalMode(OneTree); }
  void SetTraversalModeToSequential() { this->SetTraversalMode(Sequential); }
  void SetTraversalModeToParallel() { this->SetTraversalMode(Parallel); }
  /// @}

  /// What happens when dynamic objects have moved; the result is the same.
  enum UpdateModes
  {
    Rebuild = 0, ///< all walks are shot again
    Verify = 1   ///< the stored walks are verified and those that changed repaired
  };

  /// @{
  /** See UpdateModes. Default Verify. */
  vtkSetClampMacro(UpdateMode, int, Rebuild, Verify);
  vtkGetMacro(UpdateMode, int);
  void SetUpdateModeToRebuild() { this->SetUpdateMode(Rebuild); }
  void SetUpdateModeToVerify() { this->SetUpdateMode(Verify); }
  /// @}

  /// @{
  /**
   * Whether a static hit that a dynamic object hides is kept for when that has gone again. The
   * result is the same. Default off: it costs about 15 % of a frame, more than it saves.
   */
  vtkSetMacro(CacheStaticHits, vtkTypeBool);
  vtkGetMacro(CacheStaticHits, vtkTypeBool);
  vtkBooleanMacro(CacheStaticHits, vtkTypeBool);
  /// @}

  /// @{
  /**
   * Number of independent replicates from which errors are estimated, 2 to 256. With few, the
   * interval is wide (ConfidenceFactor 12.7 with 2, 2.13 with 16, 2.00 with 64); with many, each
   * has few walks, and less is gained by the evenness of the samples. Default 16.
   */
  vtkSetMacro(NumberOfReplicates, int);
  vtkGetMacro(NumberOfReplicates, int);
  /// @}

  /// @{
  /**
   * With SpreadWalks, and where Automatic spreads, on how many photons a small cell draws, 1 to
   * 1,000,000. The noise is about 1 / its root; the blur grows with its root. Power is conserved on
   * each connection. Default 250.
   */
  vtkSetMacro(NumberOfSpreadPhotons, int);
  vtkGetMacro(NumberOfSpreadPhotons, int);
  /// @}

  /// @{
  /**
   * Whether each process of the Controller has a piece of every input, instead of all of it. The
   * pieces are put together on each process; its output has the cells of its own. Cells are ordered
   * by their global ids, or else by their places, so the result does not depend on the division; it
   * has other bits than that of the same input in another order. A part that all processes have
   * alike counts once. All pieces with cells need the same cell arrays, and the inputs the same
   * blocks; the pose of a part is that of the first process that has cells of it. Walks to look at
   * cannot be chosen by a cell. Default off.
   */
  vtkSetMacro(DistributedInput, vtkTypeBool);
  vtkGetMacro(DistributedInput, vtkTypeBool);
  vtkBooleanMacro(DistributedInput, vtkTypeBool);
  /// @}

  /// @{
  /**
   * The name of a further field-data array with a pose (16 values, row by row), by which each part
   * of port 1 that has one is moved first: world = transform or `ObjectToWorld` * this. If a part
   * of a connection has it, all with cells need it. `globalTransform` is for vtkGLTFReader with
   * ApplyDeformationsToGeometry off (with that on, points have been moved already). Null or empty,
   * the default: none.
   */
  vtkSetStringMacro(PoseArrayName);
  vtkGetStringMacro(PoseArrayName);
  /// @}

  /// @}

  /// Includes the transforms.
  vtkMTimeType GetMTime() override;

  /// @name Old names
  /// They work for this release; each warns once, and names what to use instead.
  /// @{

  /// Of Method: the parts of which it says one thing.
  enum OldMethodParts
  {
    Shot = 0,
    AutomaticDirectLight = 2,
    Sums = 0,
    Spread = 1,
    FinalGather = 3,
    AutomaticEstimate = 4,
    SmallCells = 0,
    AllCells = 2
  };
  void SetDirectLight(int part) { this->SetMethodPart(DirectLightPart, part); }
  int GetDirectLight() { return this->GetMethodPart(DirectLightPart); }
  void SetDirectLightToShot() { this->SetDirectLight(Shot); }
  void SetDirectLightToGathered() { this->SetDirectLight(Gathered); }
  void SetDirectLightToAutomatic() { this->SetDirectLight(AutomaticDirectLight); }
  void SetCellEstimate(int part) { this->SetMethodPart(CellEstimatePart, part); }
  int GetCellEstimate() { return this->GetMethodPart(CellEstimatePart); }
  void SetCellEstimateToSums() { this->SetCellEstimate(Sums); }
  void SetCellEstimateToSpread() { this->SetCellEstimate(Spread); }
  void SetCellEstimateToGathered() { this->SetCellEstimate(FinalGather); }
  void SetCellEstimateToAutomatic() { this->SetCellEstimate(AutomaticEstimate); }
  void SetGatherOn(int part) { this->SetMethodPart(GatherOnPart, part); }
  int GetGatherOn() { return this->GetMethodPart(GatherOnPart); }
  void SetGatherOnToSmallCells() { this->SetGatherOn(SmallCells); }
  void SetGatherOnToAllCells() { this->SetGatherOn(AllCells); }
  void SetUnbiasedGather(int part) { this->SetMethodPart(UnbiasedGatherPart, part); }
  int GetUnbiasedGather() { return this->GetMethodPart(UnbiasedGatherPart); }
  void UnbiasedGatherOn() { this->SetUnbiasedGather(1); }
  void UnbiasedGatherOff() { this->SetUnbiasedGather(0); }

  /// Of NumberOfRays.
  void SetNumberOfGatherRays(int rays);
  int GetNumberOfGatherRays() { return this->NumberOfRays; }
  /// Of MaximumEffort: in walks, and in rays. -1: as that says.
  void SetMaximumNumberOfWalks(vtkIdType walks);
  vtkIdType GetMaximumNumberOfWalks();
  void SetMaximumNumberOfGatherRays(int rays);
  int GetMaximumNumberOfGatherRays();

  /// Of vtkPhotonWalksFilter: output port 1 shows the same walks. GetOutput(1) is null, as it is no
  /// vtkMultiBlockDataSet.
  void SetNumberOfOutputWalks(vtkIdType walks);
  vtkGetMacro(NumberOfOutputWalks, vtkIdType);
  vtkSetMacro(OutputWalksCell, vtkIdType);
  vtkGetMacro(OutputWalksCell, vtkIdType);
  vtkSetMacro(OutputWalksPort, int);
  vtkGetMacro(OutputWalksPort, int);
  vtkSetMacro(OutputWalksConnection, int);
  vtkGetMacro(OutputWalksConnection, int);
  vtkPolyData* GetWalksOutput();
  vtkAlgorithmOutput* GetWalksOutputPort() { return this->GetOutputPort(1); }

  /// Gone; one error names vtkKeyFramedPose, which gives poses over time.
  void SetDynamicTransformInterpolator(int i, vtkTransformInterpolator* worldFromObject);

  /// Of GetFigure().
  double GetEmittedPower() { return this->GetOldFigure("EmittedPower"); }
  double GetAbsorbedPower() { return this->GetOldFigure("AbsorbedPower"); }
  double GetEscapedPower() { return this->GetOldFigure("EscapedPower"); }
  double GetStalePower() { return this->GetOldFigure("StalePower"); }
  double GetReachedRelativeError() { return this->GetOldFigure("ReachedRelativeError"); }
  double GetShootSeconds() { return this->GetOldFigure("ShootSeconds"); }
  double GetVerifySeconds() { return this->GetOldFigure("VerifySeconds"); }
  double GetRepairSeconds() { return this->GetOldFigure("RepairSeconds"); }
  double GetNumberOfShotWalks() { return this->GetOldFigure("NumberOfShotWalks", "NumberOfWalks"); }
  double GetNumberOfCastGatherRays()
  {
    return this->GetOldFigure("NumberOfCastGatherRays", "NumberOfGatherRays");
  }
  double GetNumberOfSegments() { return this->GetOldFigure("NumberOfSegments"); }
  double GetNumberOfInvalidWalks() { return this->GetOldFigure("NumberOfInvalidWalks"); }
  double GetNumberOfRepairedSegments() { return this->GetOldFigure("NumberOfRepairedSegments"); }
  double GetHistoryBytes() { return this->GetOldFigure("HistoryBytes"); }
  /// @}

protected:
  vtkIrradianceFilter();
  ~vtkIrradianceFilter() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkIdType NumberOfWalks = 1000000;
  int NumberOfRays = 32, NumberOfReplicates = 16, NumberOfSpreadPhotons = 250, Seed = 1;
  int TraversalMode = Parallel, UpdateMode = Verify;
  double TargetRelativeError = 0, MaximumEffort = 0, RepairTimeBudget = 0;
  double DefaultDiffuseReflectance = 0.5;
  vtkTypeBool ComputeStandardError = 0, SeparateSides = 0, CacheStaticHits = 0;
  vtkTypeBool DistributedInput = 0, ComputeLightGroups = 0;
  char* PoseArrayName = nullptr;
  vtkIdType NumberOfOutputWalks = 0, OutputWalksCell = -1;
  int OutputWalksPort = 0, OutputWalksConnection = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkMTimeType OwnTime();
  vtkMTimeType InputTime();
  bool HasChangedMeanwhile();
  double GetOldFigure(const char* getter, const char* name = nullptr);
  enum MethodPart
  {
    DirectLightPart,
    CellEstimatePart,
    GatherOnPart,
    UnbiasedGatherPart
  };
  void SetMethodPart(MethodPart part, int value);
  int GetMethodPart(MethodPart part);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
