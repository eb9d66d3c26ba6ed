// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIrradianceFilter
 * @brief   irradiance of every cell of a scene in which things move
 *
 * Shoots photon walks from the lights of the scene and stores them if something may move. Each
 * further update verifies the stored walks against the objects that moved, and repairs only those
 * that changed. The result equals a new filter's on the same input, bit for bit, for any number of
 * threads, any traversal mode, with and without the cache (but see RepairTimeBudget).
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
 * them. Polygons and triangle strips are surfaces, opaque, whose front is the side from which
 * points run counter-clockwise; vertex cells with a flux are point lights. Where a pose mirrors
 * (its determinant is negative), the front is the mirror image of the front, as in glTF, on which
 * points run clockwise in the world; the cells of the output keep their own order of points. All
 * lengths are metres. Cell arrays have one component, or three for three bands.
 * SetInputArrayToProcess(index, ...) chooses others:
 * | index | default name         | meaning                                        |
 * |-------|----------------------|------------------------------------------------|
 * | 0     | RadiantExitance      | W/m2 emitted from the front, diffuse; >= 0     |
 * | 1     | DiffuseReflectance   | 0..1, both sides; absent: DefaultDiffuseReflectance |
 * | 2     | SpecularReflectance  | 0..1, both sides; absent: 0                    |
 * | 3     | PhongExponent        | >= 0, one component; infinite or absent: mirror |
 * | 4     | RadiantFlux          | W of a vertex cell; >= 0                       |
 *
 * @section Output
 * Port 0: vtkMultiBlockDataSet with the blocks `Static` and `Dynamic`, each with one vtkPolyData
 * per connection, in order, in world coordinates. Added are the cell array `Irradiance` (double,
 * W/m2), arrays of the properties below, and field data with the figures of the update. Port 1:
 * walks, see NumberOfOutputWalks. Input that cannot be computed is one error that names the input,
 * the cell and the value, and an empty output. What is hardly meant is a warning.
 *
 * Progress is reported and AbortExecute honoured within 0.1 s. Runs on VTK's threads (vtkSMPTools),
 * and on the processes of the Controller. If they ask for pieces, the first has the whole result,
 * unless DistributedInput.
 */

#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

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

  /// How rays search the static and the dynamic geometry; the result is the same.
  enum TraversalModes
  {
    OneTree = 0,    ///< one tree over all triangles, rebuilt whenever something moves
    Sequential = 1, ///< the dynamic trees, then the static one up to the hit found
    Parallel = 2    ///< likewise, but beside many or flattened objects the static tree first, then
                    ///< what is before its hit
  };

  /// How the light gets to be known that comes straight from the lights.
  enum DirectLights
  {
    Shot = 0,                ///< walks start at the lights, and bring it
    Gathered = 1,            ///< each cell looks for the lights, and walks start where it sees them
    AutomaticDirectLight = 2 ///< "Automatic": one of these, by the scene
  };

  /// From which photons the irradiance of a cell is estimated.
  enum CellEstimates
  {
    Sums = 0,   ///< the photons that arrived in it
    Spread = 1, ///< small cells: also the photons in the cells around it
    FinalGather =
      3, ///< "Gathered". Small cells: what rays from them find on the cells that they hit
    AutomaticEstimate = 4 ///< "Automatic": "Gathered" or Spread, by the scene
  };

  /// Which cells look for their indirect light with the estimate Gathered.
  enum GatheringCells
  {
    SmallCells = 0, ///< those that expect few photons
    AllCells = 2
  };

  /// What happens when dynamic objects have moved; the result is the same.
  enum UpdateModes
  {
    Rebuild = 0, ///< all walks are shot again
    Verify = 1   ///< the stored walks are verified and those that changed repaired
  };

  /// @{
  /**
   * Pose (model to world) of the i-th connection of port 1, null for none: then the pose is the
   * field-data array `ObjectToWorld` (16 values, row by row) of the input, or else the identity.
   * Any invertible affine map will do. A leaf of composite data with an `ObjectToWorld` is moved by
   * that first. It is kept by reference: setting or changing it makes the filter execute, even if
   * an observer of the progress changes it during a run. Indices follow the connections: after
   * removing one, set the transforms again.
   */
  void SetDynamicTransform(int i, vtkLinearTransform* worldFromObject);
  vtkLinearTransform* GetDynamicTransform(int i);
  /// @}

  /// Gone; one error names vtkKeyFramedPose, which gives poses over time.
  void SetDynamicTransformInterpolator(int i, vtkTransformInterpolator* worldFromObject);

  /// Removes all dynamic transforms.
  void RemoveAllDynamicTransforms();

  /// @{
  /**
   * The pose of connection i as 16 values, row by row, with (0, 0, 0, 1) in the last row. Like
   * SetDynamicTransform with a new transform; it is for callers that have numbers.
   */
  void SetDynamicMatrix(int i, double m00, double m01, double m02, double m03, double m10,
    double m11, double m12, double m13, double m20, double m21, double m22, double m23, double m30,
    double m31, double m32, double m33);
  void SetDynamicMatrix(int i, const double elements[16]);
  /// @}

  /// Removes the inputs of port 1; the poses stay.
  void RemoveAllDynamicInputs();

  /**
   * From which cell array a quantity is read. `quantity`: the default name of an array in the table
   * above, such as "DiffuseReflectance"; another is an error. `name`: any other array with that
   * meaning. Empty, null or "None": the quantity is read from none, even if there is such an array.
   */
  void SetCellArray(const char* quantity, const char* name);

  /// @{
  /**
   * The name of a further field-data array with a pose (16 values, row by row), by which each part
   * of port 1 that has one is moved first: world = transform or `ObjectToWorld` * this. If a part
   * of a connection has it, all with cells need it. `globalTransform` is for vtkGLTFReader with
   * ApplyDeformationsToGeometry off; with that on, the array is there as well, but its points have
   * been moved already. Null or empty: none. Default none.
   */
  vtkSetStringMacro(PoseArrayName);
  vtkGetStringMacro(PoseArrayName);
  /// @}

  /// @{
  /**
   * Number of photon walks, 1 to 4,294,967,295; at least NumberOfReplicates if those are used. The
   * error of a cell falls with about its square root. Default 1,000,000.
   */
  vtkSetMacro(NumberOfWalks, vtkIdType);
  vtkGetMacro(NumberOfWalks, vtkIdType);
  /// @}

  /// @{
  /**
   * Chooses the random scrambling of the samples. Two seeds give independent results. Default 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  /// @}

  /// @{
  /**
   * Diffuse reflectance, 0..1, of inputs without such an array. Default 0.5.
   */
  vtkSetMacro(DefaultDiffuseReflectance, double);
  vtkGetMacro(DefaultDiffuseReflectance, double);
  /// @}

  /// @{
  /**
   * See TraversalModes. Default Parallel.
   */
  vtkSetClampMacro(TraversalMode, int, OneTree, Parallel);
  vtkGetMacro(TraversalMode, int);
  void SetTraversalModeToOneTree() { this->SetTraversalMode(OneTree); }
  void SetTraversalModeToSequential() { this->SetTraversalMode(Sequential); }
  void SetTraversalModeToParallel() { this->SetTraversalMode(Parallel); }
  /// @}

  /// @{
  /**
   * See UpdateModes. Default Verify.
   */
  vtkSetClampMacro(UpdateMode, int, Rebuild, Verify);
  vtkGetMacro(UpdateMode, int);
  void SetUpdateModeToRebuild() { this->SetUpdateMode(Rebuild); }
  void SetUpdateModeToVerify() { this->SetUpdateMode(Verify); }
  /// @}

  /// @{
  /**
   * Whether a static hit that a dynamic object hides is kept for when the object has gone again.
   * Changes the time, not the result. Default off: to keep the hits costs more than they save,
   * about 15 % of a frame, also where a part goes to and fro.
   */
  vtkSetMacro(CacheStaticHits, vtkTypeBool);
  vtkGetMacro(CacheStaticHits, vtkTypeBool);
  vtkBooleanMacro(CacheStaticHits, vtkTypeBool);
  /// @}

  /// @{
  /**
   * Seconds that the repair of an update may take; 0: no limit. Verification does not count, nor
   * does the first shooting. No effect if UpdateMode is Rebuild or everything has to be shot again:
   * then nothing is stale. What is left is repaired by the next executions: without motion call
   * Modified() and Update() until GetStalePower() is 0. Until then the cell array `StaleIrradiance`
   * (`StaleIrradianceFront`, `StaleIrradianceBack`; W/m2) is the part of the irradiance that rests
   * on walks that are no longer valid, and the field `StaleGainBound` (W) is the most that the full
   * update can bring to all cells together. See "A time budget" in the Guide. Default 0.
   */
  vtkSetMacro(RepairTimeBudget, double);
  vtkGetMacro(RepairTimeBudget, double);
  /// @}

  /// @{
  /**
   * The processes that share the walks; null: this one alone. Each process has the whole scene,
   * shoots and stores its part of the walks, and has the whole output, with the bits that one
   * process alone would give. All of them have to update the filter at the same time, with the same
   * inputs and settings; else, or if one fails, each has one error. HistoryBytes and the seconds
   * are this process's own. Where single photons are read (vtkIrradianceProbeFilter with Estimate
   * Nearest; without SeparateSides and CellEstimate Gathered also its other estimate, and
   * vtkOutgoingRadianceFilter) each process shoots and stores all walks; with several processes
   * that excludes a RepairTimeBudget. See "Several processes" in the Guide. Default: VTK's global
   * controller when the filter is made, so this process alone unless a program, such as ParaView's
   * server, has set another.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  /// @}

  /// @{
  /**
   * Whether each process of the Controller has a piece of every input, instead of all of it. Then
   * the filter asks for pieces, puts them together on each process, and its output has the cells of
   * the process's own pieces. Cells are ordered by their global ids, if they have some, and else by
   * their places, so the result does not depend on the division; it has other bits than that of the
   * same input in another order. A part that all processes have alike is whole, and counts once.
   * All pieces with cells need the same cell arrays, and the inputs the same blocks, on each
   * process; the pose of a part is that of the first process that has cells of it. OutputWalksCell
   * has to be -1. Default off.
   */
  vtkSetMacro(DistributedInput, vtkTypeBool);
  vtkGetMacro(DistributedInput, vtkTypeBool);
  vtkBooleanMacro(DistributedInput, vtkTypeBool);
  /// @}

  /// @{
  /**
   * Whether the irradiance of the two sides of a cell is computed separately: `IrradianceFront` and
   * `IrradianceBack` in place of `Irradiance`, which adds up both. Default off.
   */
  vtkSetMacro(SeparateSides, vtkTypeBool);
  vtkGetMacro(SeparateSides, vtkTypeBool);
  vtkBooleanMacro(SeparateSides, vtkTypeBool);
  /// @}

  /// @{
  /**
   * See DirectLights, and "Shot or gathered" in the Guide. Both have the same mean. Gathered is
   * less noisy in the same time where the lights shine freely on the cells, the more so the less is
   * reflected. Lamps very near to large cells want Shot. Automatic is Gathered where small cells
   * could cast rays, and where there are no more cells than walks, unless it costs too much with
   * CellEstimate Spread; else Shot; the field `DirectLight` of the output says what it is. An
   * update still equals a new filter's result, bit for bit. Photons are then those of indirect
   * light: what reads them adds the direct light that cells, or sensors, gather.
   *
   * Standard errors are those of both parts; where a cell takes fewer than 64 samples for its
   * direct light, the intervals are a little too wide (98 to 99 % of them hold the truth).
   * `EmittedPower` is that of the lights and equals `AbsorbedPower` + `EscapedPower`, but how these
   * divide is then an estimate as well: in a closed scene `EscapedPower` is zero only within the
   * field `EscapedPowerStandardError`, and may be negative. About `NumberOfWalks` walks start, if
   * the light falls on cells that reflect as static ones do on average. Changing it shoots all
   * again. Default Automatic.
   */
  vtkSetClampMacro(DirectLight, int, Shot, AutomaticDirectLight);
  vtkGetMacro(DirectLight, int);
  void SetDirectLightToShot() { this->SetDirectLight(Shot); }
  void SetDirectLightToGathered() { this->SetDirectLight(Gathered); }
  void SetDirectLightToAutomatic() { this->SetDirectLight(AutomaticDirectLight); }
  /// @}

  /// @{
  /**
   * See CellEstimates, and "Small cells" in the Guide. Spread conserves the power on each
   * connection and trades noise for blur. Gathered finds the indirect light of small cells by
   * NumberOfGatherRays rays from each, and needs DirectLight Gathered or Automatic; a point light
   * beside cells with a SpecularReflectance is an error. Automatic is Gathered where that pays,
   * else Spread: it takes a DirectLight other than Shot, no such point light, that cells which
   * expect 25 of NumberOfWalks or more have half of the area, that the rays of all small cells are
   * at most 1.2 times NumberOfWalks, else cells have fewer rays, down to 4, and that what rests is
   * lit evenly, or parts catch few photons. With UnbiasedGather it is Sums. The field
   * `CellEstimate` of the output says what it is. Changing it shoots no walks, except if UpdateMode is
   * Rebuild, with a target where nothing is dynamic, or from or to Gathered. Default Automatic.
   */
  vtkSetClampMacro(CellEstimate, int, Sums, AutomaticEstimate);
  vtkGetMacro(CellEstimate, int);
  void SetCellEstimateToSums() { this->SetCellEstimate(Sums); }
  void SetCellEstimateToSpread() { this->SetCellEstimate(Spread); }
  void SetCellEstimateToGathered() { this->SetCellEstimate(FinalGather); }
  void SetCellEstimateToAutomatic() { this->SetCellEstimate(AutomaticEstimate); }
  /// @}

  /// @{
  /**
   * With CellEstimate Spread, on how many photons a small cell draws, 1 to 1,000,000. The noise is
   * about 1 / its root; the blur grows with its root. Changing it is like changing CellEstimate.
   * Default 250.
   */
  vtkSetMacro(NumberOfSpreadPhotons, int);
  vtkGetMacro(NumberOfSpreadPhotons, int);
  /// @}

  /// @{
  /**
   * With CellEstimate Gathered, how many rays look for the indirect light of each side of a small
   * cell, 1 to 4096; with error bars rounded up to a multiple of NumberOfReplicates. A cell is
   * small if it would receive fewer than two photons for each ray when NumberOfWalks walks arrived
   * evenly over all area. The noise falls with the root of the number, or faster; the time grows
   * with it. Each cell gathers its direct light with half as many samples at least, or 8. So
   * changing it shoots all walks. Default 32.
   */
  vtkSetMacro(NumberOfGatherRays, int);
  vtkGetMacro(NumberOfGatherRays, int);
  /// @}

  /// @{
  /**
   * With CellEstimate Gathered, which cells find their indirect light by rays, see GatheringCells.
   * Large cells take four times as many rays, and samples of direct light, as small ones. That is
   * less noisy than their photons by far where each surface has one reflectance, and a tenth of the
   * walks then serves as well. Changing it shoots all walks where the numbers of samples change,
   * else none. Default SmallCells.
   */
  vtkSetClampMacro(GatherOn, int, SmallCells, AllCells);
  vtkGetMacro(GatherOn, int);
  void SetGatherOnToSmallCells() { this->SetGatherOn(SmallCells); }
  void SetGatherOnToAllCells() { this->SetGatherOn(AllCells); }
  /// @}

  /// @{
  /**
   * With CellEstimate Gathered, whether rays take nothing from the cells that they hit: they go on,
   * and look for the lights wherever they hit (path tracing). The irradiance is then without bias,
   * however large cells are, with more noise. Changing it is like changing CellEstimate. Default
   * off.
   */
  vtkSetMacro(UnbiasedGather, vtkTypeBool);
  vtkGetMacro(UnbiasedGather, vtkTypeBool);
  vtkBooleanMacro(UnbiasedGather, vtkTypeBool);
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
   * Number of independent replicates from which errors are estimated, 2 to 256. With few, the
   * estimate is crude and the interval wide (ConfidenceFactor 12.7 with 2, 2.13 with 16, 2.00 with
   * 64). With many, each has few walks, and less is gained by the evenness of the samples.
   * Default 16.
   */
  vtkSetMacro(NumberOfReplicates, int);
  vtkGetMacro(NumberOfReplicates, int);
  /// @}

  /// @{
  /**
   * 0 to 1; 5 % is 0.05. If positive, NumberOfWalks are shot first, and their number is doubled
   * until the half-width of the 95 % interval is at most this times the irradiance on 95 % of the
   * area. Where cells gather, NumberOfGatherRays is doubled likewise, whichever promises more for
   * its time. If that takes more than MaximumNumberOfWalks and MaximumNumberOfGatherRays, a warning
   * says what was reached. A cell that has received nothing meets the target if 3 more photons
   * would make it no brighter than this times the average; a cell with too few photons does not.
   * Updates shoot more or fewer, as the scene needs. 0: no target. Default 0.
   */
  vtkSetMacro(TargetRelativeError, double);
  vtkGetMacro(TargetRelativeError, double);
  /// @}

  /// @{
  /**
   * With a TargetRelativeError, the number of walks at which to stop; NumberOfWalks to
   * 4,294,967,295. If something may move, one band takes 30 bytes for each segment and 30 for each
   * walk, some 46 a segment in a room that reflects half; after motions, which leave holes, up to
   * 1.7 times that. See `HistoryBytes`. Default 10,000,000.
   */
  vtkSetMacro(MaximumNumberOfWalks, vtkIdType);
  vtkGetMacro(MaximumNumberOfWalks, vtkIdType);
  /// @}

  /// @{
  /**
   * With a TargetRelativeError and CellEstimate Gathered, the number of rays from each side of a
   * small cell at which to stop; NumberOfGatherRays to 65,536. If something may move, the paths of
   * the rays are kept in 32 bytes a segment and 24 a path. Changing it is like changing
   * NumberOfGatherRays, but shoots no walks, except if UpdateMode is Rebuild or nothing is dynamic.
   * Default 1024.
   */
  vtkSetMacro(MaximumNumberOfGatherRays, int);
  vtkGetMacro(MaximumNumberOfGatherRays, int);
  /// @}

  /// @{
  /**
   * How many walks output port 1 shows, 0 to 4,294,967,295, as polylines from the light to where
   * the photon is absorbed, with the cell arrays `WalkId`, `Power` (W), `Repaired`, `Escaped` and
   * `Stale`; see "Walks to look at" in the Guide. Where nothing can move, no walks are stored, and
   * all are shot again when it is not 0 for the first time; they then stay. Otherwise changing it
   * shoots nothing, except if UpdateMode is Rebuild, or with a target where nothing is dynamic.
   * Default 0.
   */
  vtkSetMacro(NumberOfOutputWalks, vtkIdType);
  vtkGetMacro(NumberOfOutputWalks, vtkIdType);
  /// @}

  /// @{
  /**
   * The cell that the walks of output port 1 touch: its number in connection OutputWalksConnection
   * of input port OutputWalksPort (0 static, 1 dynamic). In a composite connection the cells are
   * numbered from leaf to leaf. -1: all walks are meant, and port and connection do not matter.
   * What does not exist is an error, except that no walk touches the cells of a connection that has
   * none. They only matter if NumberOfOutputWalks is not 0. Defaults -1, 0, 0.
   */
  vtkSetMacro(OutputWalksCell, vtkIdType);
  vtkGetMacro(OutputWalksCell, vtkIdType);
  vtkSetMacro(OutputWalksPort, int);
  vtkGetMacro(OutputWalksPort, int);
  vtkSetMacro(OutputWalksConnection, int);
  vtkGetMacro(OutputWalksConnection, int);
  /// @}

  /// @{
  /**
   * Output port 1. GetOutput(1) is null, as it is no vtkMultiBlockDataSet.
   */
  vtkPolyData* GetWalksOutput();
  vtkAlgorithmOutput* GetWalksOutputPort();
  /// @}

  /**
   * A figure of the last update by its name in the field data of the output, such as
   * "EmittedPower"; the sum over bands. W, seconds, bytes; NaN where the output has no such figure.
   */
  double GetFigure(const char* name);

  /// @{
  /// Old names of GetFigure(), for one release: each warns once.
  double GetEmittedPower() { return this->GetOldFigure("GetEmittedPower", "EmittedPower"); }
  double GetAbsorbedPower() { return this->GetOldFigure("GetAbsorbedPower", "AbsorbedPower"); }
  double GetEscapedPower() { return this->GetOldFigure("GetEscapedPower", "EscapedPower"); }
  double GetStalePower() { return this->GetOldFigure("GetStalePower", "StalePower"); }
  double GetReachedRelativeError()
  {
    return this->GetOldFigure("GetReachedRelativeError", "ReachedRelativeError");
  }
  double GetShootSeconds() { return this->GetOldFigure("GetShootSeconds", "ShootSeconds"); }
  double GetVerifySeconds() { return this->GetOldFigure("GetVerifySeconds", "VerifySeconds"); }
  double GetRepairSeconds() { return this->GetOldFigure("GetRepairSeconds", "RepairSeconds"); }
  double GetNumberOfShotWalks()
  {
    return this->GetOldFigure("GetNumberOfShotWalks", "NumberOfWalks");
  }
  double GetNumberOfCastGatherRays()
  {
    return this->GetOldFigure("GetNumberOfCastGatherRays", "NumberOfGatherRays");
  }
  double GetNumberOfSegments()
  {
    return this->GetOldFigure("GetNumberOfSegments", "NumberOfSegments");
  }
  double GetNumberOfInvalidWalks()
  {
    return this->GetOldFigure("GetNumberOfInvalidWalks", "NumberOfInvalidWalks");
  }
  double GetNumberOfRepairedSegments()
  {
    return this->GetOldFigure("GetNumberOfRepairedSegments", "NumberOfRepairedSegments");
  }
  double GetHistoryBytes() { return this->GetOldFigure("GetHistoryBytes", "HistoryBytes"); }
  /// @}

  /// Includes the transforms.
  vtkMTimeType GetMTime() override;

protected:
  vtkIrradianceFilter();
  ~vtkIrradianceFilter() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* output) override;

  char* PoseArrayName = nullptr;
  vtkIdType NumberOfWalks = 1000000;
  int Seed = 1;
  double DefaultDiffuseReflectance = 0.5;
  int TraversalMode = Parallel;
  int UpdateMode = Verify;
  vtkTypeBool CacheStaticHits = 0;
  vtkTypeBool SeparateSides = 0;
  int DirectLight = AutomaticDirectLight;
  int CellEstimate = AutomaticEstimate;
  int NumberOfSpreadPhotons = 250;
  int NumberOfGatherRays = 32;
  int GatherOn = SmallCells;
  vtkTypeBool UnbiasedGather = 0;
  vtkTypeBool ComputeStandardError = 0;
  int NumberOfReplicates = 16;
  double TargetRelativeError = 0;
  vtkIdType MaximumNumberOfWalks = 10000000;
  int MaximumNumberOfGatherRays = 1024;
  double RepairTimeBudget = 0;
  vtkIdType NumberOfOutputWalks = 0;
  vtkIdType OutputWalksCell = -1;
  int OutputWalksPort = 0;
  int OutputWalksConnection = 0;
  vtkTypeBool DistributedInput = 0;

private:
  vtkIrradianceFilter(const vtkIrradianceFilter&) = delete;
  void operator=(const vtkIrradianceFilter&) = delete;

  vtkMTimeType OwnTime();
  vtkMTimeType InputTime();
  bool HasChangedMeanwhile();
  double GetOldFigure(const char* getter, const char* name);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
