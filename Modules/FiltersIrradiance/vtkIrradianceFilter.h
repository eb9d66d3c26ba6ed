// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIrradianceFilter
 * @brief   irradiance of every cell of a scene in which things move
 *
 * Shoots photon walks from the lights of the scene and stores them if something may move. Each
 * further update verifies the stored walks against the objects that moved, and repairs only those
 * that changed. The result equals that of a new filter on the same input, bit for bit, for any
 * number of threads, any traversal mode, with and without the cache (but see RepairTimeBudget).
 *
 * After Szecsi, Benedek and Szirmay-Kalos, "Accelerating Animation Through Verification of Shooting
 * Walks" (SCCG 2003).
 *
 * @section Inputs
 * - Port 0, static: vtkPolyData, repeatable, optional.
 * - Port 1, dynamic: vtkPolyData in model coordinates, repeatable, optional. The pose is that of
 *   SetDynamicTransform or SetDynamicTransformInterpolator; without one, the field-data array
 *   `ObjectToWorld` (16 values, row by row) of the input; else the identity. Any invertible affine map will do. On port 0 such an array
 *   moves nothing, and a warning says so.
 *
 * A dynamic part, a connection of port 1 or a leaf of it, that has no cells is not there. When it
 * comes or goes, that is an update like a motion: only walks that it touches are shot again, and no
 * tree is built for what was there before. Unless it emits light: then all is shot anew, as when the
 * number of its cells changes in any other way, or when something with other cells comes while a
 * RepairTimeBudget has left walks stale.
 *
 * Both ports also take composite data (vtkMultiBlockDataSet, vtkPartitionedDataSet,
 * vtkPartitionedDataSetCollection). All leaves belong to the scene and have to be vtkPolyData;
 * empty blocks are skipped. The pose of the connection moves all leaves; a leaf with an
 * `ObjectToWorld` of its own is moved by that first: world = connection * leaf.
 *
 * Polygons and triangle strips are surfaces. Their front is the side from which the points of a
 * cell run counter-clockwise in world coordinates (so a reflecting transform flips it). Vertex
 * cells with a flux are isotropic point lights; several points share the flux of their cell. Lines
 * are passed through. Ghost cells (`vtkGhostType`) that are duplicates or hidden take no part: they
 * neither emit nor block light, and their irradiance is 0.
 *
 * Faces may coincide. A closed mesh is a body, which no light enters even where it stands exactly
 * on a lamp; a closed static mesh that encloses the rest is a room. A point light exactly in its
 * wall shines into the room with all of its power. Documentation/Theory.md, section 3: the rules.
 *
 * @section Arrays Cell arrays read
 * SetInputArrayToProcess(index, ...) chooses others; one that is on no input's cells is an error.
 * Arrays have one component, or three for three bands.
 * | index | default name         | meaning                                        |
 * |-------|----------------------|------------------------------------------------|
 * | 0     | RadiantExitance      | W/m2 emitted from the front, diffuse; >= 0     |
 * | 1     | DiffuseReflectance   | 0..1, both sides; absent: DefaultDiffuseReflectance |
 * | 2     | SpecularReflectance  | 0..1, both sides; absent: 0                    |
 * | 3     | PhongExponent        | >= 0, one component; infinite or absent: mirror |
 * | 4     | RadiantFlux          | W of a vertex cell; >= 0                       |
 *
 * SetCellArray("RadiantExitance", name) does the same for cell arrays, by the quantity's default name.
 *
 * Diffuse and specular reflectance add up to at most 1 in each band. The specular part reflects
 * around the mirror direction: a Phong lobe of cos^n, made reciprocal and to reflect all of the
 * SpecularReflectance at every angle (Documentation/Theory.md, section 1.1). The larger the exponent
 * n, the narrower the lobe, down to a perfect mirror. PhongExponent matters only where
 * SpecularReflectance is not 0.
 *
 * Exitance on vertices and lines, and flux on lines and faces, are not read: a warning, or an error
 * if the input has no cell of the right kind. Arrays of these names on points: a warning. So is a cell
 * array that is called nearly so ("radiant exitance (W/m2)", "Albedo"), if the input has no array for
 * that quantity and none was chosen.
 *
 * @section Output
 * Port 0: vtkMultiBlockDataSet with the blocks `Static` and `Dynamic`, each a vtkMultiBlockDataSet with one
 * vtkPolyData per connection, in order: the input's points (dynamic ones in world coordinates, as
 * are the active normals; integers become double), its cells and arrays, and the cell array
 * `Irradiance` (double, W/m2, one or three components, both sides summed), or `IrradianceFront` and
 * `IrradianceBack` if SeparateSides is on. Cells without area, vertices and lines have 0. A dynamic
 * input's `ObjectToWorld` is applied and not passed on. A composite connection has a block of its
 * structure instead: a vtkMultiPieceDataSet for a vtkPartitionedDataSet (which a
 * vtkMultiBlockDataSet may not hold), else a vtkMultiBlockDataSet. The block of a connection is
 * called as the first value of its input's field array `Name` (vtkStringArray), such as "lamp"; without
 * one "Static 0", "Dynamic 1" and so on. Blocks within a composite connection keep their names.
 *
 * By CellEstimate, the irradiance of a small cell may draw on the cells around it, see below.
 *
 * ComputeStandardError adds `IrradianceStandardError`, or `IrradianceFrontStandardError` and
 * `IrradianceBackStandardError`, W/m2. The 95 % interval is the irradiance +- this times
 * `ConfidenceFactor` (field data: Student's t). It is NaN where it is not known: without an area,
 * and where less than 25 times the largest power with which a walk starts has arrived.
 *
 * Field data of the root, one tuple each: `EmittedPower`, `AbsorbedPower`, `EscapedPower`,
 * `StalePower` (W, per band; emitted = absorbed + escaped; nothing is stale after an update without
 * a RepairTimeBudget), `NumberOfWalks` (those shot), `NumberOfSegments`; `ConfidenceFactor` with
 * ComputeStandardError; `ReachedRelativeError` with TargetRelativeError: the relative error within
 * which 95 % of the area is known, infinite if more than 5 % is not, NaN while walks are stale; and
 * what this update cost: `NumberOfInvalidWalks`, `NumberOfRepairedSegments`, `ShootSeconds`,
 * `VerifySeconds`, `RepairSeconds`, `HistoryBytes`.
 *
 * @section Walks Walks to look at
 * Output port 1, vtkPolyData: NumberOfOutputWalks of the walks as polylines in world coordinates
 * (double), from the light over all hits to where the photon is absorbed. A walk that escapes ends
 * with a segment to 1/8 of the diagonal of the scene beyond the box around it. It is empty if
 * NumberOfOutputWalks is 0, as it is at first, and costs nothing then. Else walks are stored also
 * where nothing can move.
 *
 * With OutputWalksCell -1 these are the first walks: samples are quasi-random, so any number of
 * first walks is spread evenly over lights, places and directions. Else they are the first of those
 * that touch a cell: that start on it or hit it. All, if there are not as many. Which ones depends
 * on nothing else.
 *
 * Cell arrays:
 * - `WalkId` (vtkIdType): the number of the walk, from 0. No two walks share one, whatever the
 *   replicates and rounds.
 * - `Power` (W, one or three components): with which it starts. Those of all walks add up to the
 *   emitted power. In one band a walk keeps it until it ends; in three bands, reflections change it.
 * - `Repaired` (0 or 1): whether the last update that shot walks again shot a part of this one
 *   again. These are the walks that touch what moved, in its pose before or after; where faces
 *   coincide also others, and with a RepairTimeBudget not all. 0 after everything was shot anew.
 *   Updates in which nothing moves or is repaired leave it as it was, so the number of walks and
 *   the cell can be changed to look at a motion from all sides. Known if NumberOfOutputWalks was
 *   not 0 when the walks were shot again.
 * - `Escaped` (0 or 1): whether the walk leaves the scene.
 * - `Stale` (0 or 1), with a RepairTimeBudget: whether a part of the walk is no longer valid and
 *   waits to be shot again. It is shown as it was, its hits moved with the things that were hit.
 *
 * Point arrays: `Bounce` (int): 0 on the light, 1 at the first hit, and so on; `Repaired` (0 or 1):
 * whether the segment that ends in this point was shot again, see above.
 *
 * All but `Repaired` and `Stale` are those of a new filter, bit for bit.
 *
 * @section Budget A time budget
 * With a RepairTimeBudget the repair of an update ends when the time is up. Walks whose stale
 * segments carry most power are repaired first. All walks have been verified by then, so it is
 * known what rests on stale walks, which are no longer valid. The output then also has
 * - the cell array `StaleIrradiance` (`StaleIrradianceFront` and `StaleIrradianceBack` with
 *   SeparateSides; W/m2): the part of the irradiance that rests on stale walks. The full update
 *   takes no more than that from a cell.
 * - the field data `StalePower`: the power that is not yet shot again.
 * - the field data `StaleGainBound` (W, per band): the full update brings no more than that to all
 *   cells together, counted from their irradiance without its stale part; infinite if walks are
 *   stale and a cell reflects more than 0.99.
 *
 * The next execution continues with what is left, whether something has moved or not. VTK executes
 * a filter only if something was modified, so without motion call Modified():
 * @code
 * irradiance->SetRepairTimeBudget(0.02);
 * irradiance->Update(); // after a motion
 * auto* stale = irradiance->GetOutput()->GetFieldData()->GetArray("StalePower");
 * while (stale->GetRange(-1)[1] > 0) // all bands; or one step at a time when the program is idle
 * {
 *   irradiance->Modified();
 *   irradiance->Update();
 *   stale = irradiance->GetOutput()->GetFieldData()->GetArray("StalePower");
 * }
 * @endcode
 * Each execution repairs some walks, however small the budget, so the loop ends; then, or after
 * SetRepairTimeBudget(0) and Update(), the result is that of a new filter, bit for bit. A target
 * waits while walks are stale; standard errors do not cover what rests on them.
 *
 * @section Estimate How small cells are estimated
 * Photons arrive by area, so finely meshed parts are noisy. With CellEstimate Spread the power that a
 * small cell received is spread over its neighbours, and the estimate of each cell draws on about
 * NumberOfSpreadPhotons photons, on the average of its connection. A cell that receives as many by
 * itself, as walls mostly do, keeps its value, to the bit. The power on each connection is conserved
 * (on port 0: on all connections together). Light is not spread over creases of more than 35 degrees,
 * gaps, edges of three cells or more, from a dynamic connection to another, nor from one side of a cell
 * to the other with SeparateSides; cells are neighbours if they share both ends of an edge exactly.
 *
 * It trades noise for blur: shadows and highlights smaller than the neighbourhood fade, and shadow edges
 * are smeared over some cells. Standard errors are those of the spread values and do not include the
 * blur. With a RepairTimeBudget, StaleIrradiance is spread alike. It is then close to what the full
 * update can take from a cell, but not a strict bound: the widths follow the number of photons.
 *
 * With CellEstimate Nearest a cell that received fewer than NumberOfSpreadPhotons is estimated from so
 * many photons nearest to its middle, as vtkIrradianceProbeFilter does, but from no farther than 2 to 2.4
 * times the distance at which the scene has them on the average. It follows the light across creases of up to
 * 45.6 degrees and from a connection to another, conserves no power, and takes far longer than Spread. After
 * a motion only cells near photons that changed, and near what moved, are estimated anew.
 * It excludes ComputeStandardError, TargetRelativeError and RepairTimeBudget: an error says so.
 *
 * @section Time Time
 * TIME_STEPS of the output are those of all inputs, and TIME_RANGE holds all of theirs and the keys
 * of the transform interpolators. The requested time (UPDATE_TIME_STEP) goes to all inputs, and each
 * decides what it is outside of its own times, as in VTK; interpolators refuse. Times may be asked for
 * in any order: a time has the same bits whenever it is asked for.
 *
 * @section Errors
 * Points that are not finite, indices past the points, arrays of the wrong size or type, values out
 * of range, singular or non-finite transforms, transforms of connections that do not exist, leaves
 * that are no polydata, point lights between walls that leave them no side to shine into, scenes
 * more than 1.3e8 times their size away from the origin (Documentation/Extremes.md): one error that
 * names the input, the cell and the value concerned, and an empty output. Inputs of other types, such as
 * unstructured grids, are an error as well: vtkGeometryFilter makes polydata of them.
 *
 * What can be computed but is hardly meant is a warning, given when cells, arrays or parts have changed,
 * not at each motion:
 * - a scene without lights, with the cell arrays that are there and not read; the irradiance is 0;
 * - lamps that shine away from all the rest of the scene and whose light is lost, and lamps whose light
 *   falls on lamps alone: cells emit from their front, and vtkReverseSense turns them;
 * - a dynamic part of more than 10 m and more than twice the size of the static scene in which it
 *   stands, and a scene of more than 100 m with less than 0.001 W/m2 on the average of its surfaces: all
 *   lengths are metres. Documentation/Extremes.md: what else these limits meet.
 *
 * Progress is reported and AbortExecute honoured within 0.1 s; after an
 * abort the output is empty and, as with all VTK filters, up to date until Modified().
 *
 * Runs on VTK's threads (vtkSMPTools).
 *
 * @section Pieces Several processes
 * Light comes from everywhere, so all of every input is asked for, and all of the result is piece 0.
 * Other pieces have the same blocks and arrays without cells, points and field data, and shoot
 * nothing: a reader that asks for n pieces gets each cell once.
 */

#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <memory> // For the internals

class vtkLinearTransform;
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
    Parallel = 2    ///< static and dynamic trees by turns, each hit shortening the other searches;
                    ///< with four objects or more the static tree, then the objects before its hit
  };

  /// From which photons the irradiance of a cell is estimated.
  enum CellEstimates
  {
    Sums = 0,   ///< those that arrived in it
    Spread = 1, ///< small cells: also those in the cells around it
    Nearest = 2 ///< small cells: those nearest to their middles
  };

  /// What happens when dynamic objects have moved; the result is the same.
  enum UpdateModes
  {
    Rebuild = 0, ///< everything is shot anew
    Verify = 1   ///< the stored walks are verified and those that changed repaired
  };

  ///@{
  /**
   * Pose (model to world) of the i-th connection of port 1, null for none. It is kept by reference:
   * setting or changing it makes the filter execute, even if an observer of the progress changes it
   * during a run. Indices follow the connections: after removing one, set the transforms again.
   */
  void SetDynamicTransform(int i, vtkLinearTransform* worldFromObject);
  vtkLinearTransform* GetDynamicTransform(int i);
  ///@}

  ///@{
  /**
   * Pose (model to world) of the i-th connection of port 1 over time, null for none: the
   * interpolator is evaluated at the requested time (UPDATE_TIME_STEP), or at its first key if none
   * is requested. It takes two keys at least, and a time outside of them is an error. The range of
   * its keys is part of the TIME_RANGE of the output; VTK gives no access to their times, so
   * TIME_STEPS has none of them.
   *
   * A connection has a transform or an interpolator: setting one removes the other.
   *
   * In VTK 9.1 an interpolator takes no notice of another pose for its first or its last key. After
   * such a change call Modified() of the interpolator; keys that change in number or range are
   * noticed. In the same version splines of rotations over three keys or more, its default, are
   * wrong, which is an error here: use SetInterpolationTypeToLinear(), or vtkKeyFramedPose.
   */
  void SetDynamicTransformInterpolator(int i, vtkTransformInterpolator* worldFromObject);
  vtkTransformInterpolator* GetDynamicTransformInterpolator(int i);
  ///@}

  /// Removes all dynamic transforms and transform interpolators.
  void RemoveAllDynamicTransforms();

  ///@{
  /**
   * The pose of connection i as 16 values, row by row, with (0, 0, 0, 1) in the last row. Like
   * SetDynamicTransform with a new transform; it is for callers that have numbers.
   */
  void SetDynamicMatrix(int i, double m00, double m01, double m02, double m03, double m10,
    double m11, double m12, double m13, double m20, double m21, double m22, double m23, double m30,
    double m31, double m32, double m33);
  void SetDynamicMatrix(int i, const double elements[16]);
  ///@}

  /// Removes the inputs of port 1; the poses stay.
  void RemoveAllDynamicInputs();

  /**
   * From which cell array a quantity is read. `quantity`: the default name of an array in the table
   * above, such as "DiffuseReflectance"; another is an error. `name`: any other array with that
   * meaning. Empty, null or "None": the quantity is read from none, even if there is such an array.
   */
  void SetCellArray(const char* quantity, const char* name);

  ///@{
  /**
   * The name of a further field-data array with a pose (16 values, row by row), by which each part of
   * port 1 that has one is moved first: world = transform or `ObjectToWorld` * this. If a part of a
   * connection has it, all with cells need it. `globalTransform` is for vtkGLTFReader with
   * ApplyDeformationsToGeometry off; with that on, the array is there as well, but its points have
   * been moved already. Null or empty: none. Default none.
   */
  vtkSetStringMacro(PoseArrayName);
  vtkGetStringMacro(PoseArrayName);
  ///@}

  ///@{
  /**
   * Number of photon walks, 1 to 4,294,967,295; at least NumberOfReplicates if those are used. The
   * error of a cell falls with about its square root. Default 1,000,000.
   */
  vtkSetMacro(NumberOfWalks, vtkIdType);
  vtkGetMacro(NumberOfWalks, vtkIdType);
  ///@}

  ///@{
  /**
   * Chooses the random scrambling of the samples. Two seeds give independent results. Default 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Diffuse reflectance, 0..1, of inputs without such an array. Default 0.5.
   */
  vtkSetMacro(DefaultDiffuseReflectance, double);
  vtkGetMacro(DefaultDiffuseReflectance, double);
  ///@}

  ///@{
  /**
   * See TraversalModes. Default Parallel.
   */
  vtkSetClampMacro(TraversalMode, int, OneTree, Parallel);
  vtkGetMacro(TraversalMode, int);
  void SetTraversalModeToOneTree() { this->SetTraversalMode(OneTree); }
  void SetTraversalModeToSequential() { this->SetTraversalMode(Sequential); }
  void SetTraversalModeToParallel() { this->SetTraversalMode(Parallel); }
  ///@}

  ///@{
  /**
   * See UpdateModes. Default Verify.
   */
  vtkSetClampMacro(UpdateMode, int, Rebuild, Verify);
  vtkGetMacro(UpdateMode, int);
  void SetUpdateModeToRebuild() { this->SetUpdateMode(Rebuild); }
  void SetUpdateModeToVerify() { this->SetUpdateMode(Verify); }
  ///@}

  ///@{
  /**
   * Whether a static hit that a dynamic object hides is kept for when the object has gone again.
   * Changes the time, not the result. Default off: to keep the hits costs as much as they save, or more,
   * also where a part goes to and fro (see the page Performance).
   */
  vtkSetMacro(CacheStaticHits, vtkTypeBool);
  vtkGetMacro(CacheStaticHits, vtkTypeBool);
  vtkBooleanMacro(CacheStaticHits, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Seconds that the repair of an update may take; 0: no limit. Verification does not count, nor
   * does the first shooting. No effect if UpdateMode is Rebuild or everything has to be shot anew:
   * then nothing is stale. See "A time budget" above. Default 0.
   */
  vtkSetMacro(RepairTimeBudget, double);
  vtkGetMacro(RepairTimeBudget, double);
  ///@}

  ///@{
  /**
   * Whether the irradiance of the two sides of a cell is computed separately. Default off.
   */
  vtkSetMacro(SeparateSides, vtkTypeBool);
  vtkGetMacro(SeparateSides, vtkTypeBool);
  vtkBooleanMacro(SeparateSides, vtkTypeBool);
  ///@}

  ///@{
  /**
   * See CellEstimates and "How small cells are estimated" above. Changing it shoots nothing anew, except
   * if UpdateMode is Rebuild, or with a target where nothing is dynamic. Default Sums.
   */
  vtkSetClampMacro(CellEstimate, int, Sums, Nearest);
  vtkGetMacro(CellEstimate, int);
  void SetCellEstimateToSums() { this->SetCellEstimate(Sums); }
  void SetCellEstimateToSpread() { this->SetCellEstimate(Spread); }
  void SetCellEstimateToNearest() { this->SetCellEstimate(Nearest); }
  ///@}

  ///@{
  /**
   * With CellEstimate Spread or Nearest, on how many photons a small cell draws, 1 to 1,000,000 (Nearest:
   * 2 at least). The noise is about
   * 1 / its root; the blur grows with its root. Changing it is like changing CellEstimate. Default 250.
   */
  vtkSetMacro(NumberOfSpreadPhotons, int);
  vtkGetMacro(NumberOfSpreadPhotons, int);
  ///@}

  ///@{
  /**
   * Whether the standard error of the irradiance is estimated, see "Output" above. Walks are
   * assigned to NumberOfReplicates replicates with samples of their own. Costs 8 bytes for each
   * cell, band, side and replicate, with a target times the rounds of walks. Default off.
   */
  vtkSetMacro(ComputeStandardError, vtkTypeBool);
  vtkGetMacro(ComputeStandardError, vtkTypeBool);
  vtkBooleanMacro(ComputeStandardError, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Number of independent replicates from which errors are estimated, 2 to 256. With few, the
   * estimate is crude and the interval wide (ConfidenceFactor 12.7 with 2, 2.13 with 16, 2.00 with
   * 64). With many, each has few walks, and less is gained by the evenness of the samples.
   * Default 16.
   */
  vtkSetMacro(NumberOfReplicates, int);
  vtkGetMacro(NumberOfReplicates, int);
  ///@}

  ///@{
  /**
   * 0 to 1; 5 % is 0.05. If positive, NumberOfWalks are shot first, and their number is doubled until
   * the half-width of the 95 % interval is at most this times the irradiance on 95 % of the area. If that takes more
   * than MaximumNumberOfWalks, a warning says what was reached. A cell that has received nothing
   * meets the target if 3 more photons would make it no brighter than this times the average; a
   * cell with too few photons does not. Updates shoot more or fewer, as the scene needs. 0: no
   * target. Default 0.
   */
  vtkSetMacro(TargetRelativeError, double);
  vtkGetMacro(TargetRelativeError, double);
  ///@}

  ///@{
  /**
   * With a TargetRelativeError, the number of walks at which to stop; NumberOfWalks to
   * 4,294,967,295. If something may move, one band takes 30 bytes for each segment and 30 for each
   * walk, some 46 a segment in a room that reflects half; after motions, which leave holes, up to
   * 1.7 times that. See `HistoryBytes`. Default 10,000,000.
   */
  vtkSetMacro(MaximumNumberOfWalks, vtkIdType);
  vtkGetMacro(MaximumNumberOfWalks, vtkIdType);
  ///@}

  ///@{
  /**
   * How many walks output port 1 shows, 0 to 4,294,967,295; see "Walks to look at" above. Where
   * nothing can move, no walks are stored, and all is shot anew when it is not 0 for the first time; they
   * then stay. Otherwise changing it shoots nothing, except if UpdateMode is Rebuild, or with a target
   * where nothing is dynamic. Default 0.
   */
  vtkSetMacro(NumberOfOutputWalks, vtkIdType);
  vtkGetMacro(NumberOfOutputWalks, vtkIdType);
  ///@}

  ///@{
  /**
   * The cell that the walks of output port 1 touch: its number in connection OutputWalksConnection
   * of input port OutputWalksPort (0 static, 1 dynamic). In a composite connection the cells are
   * numbered from leaf to leaf. -1: all walks are meant, and port and connection do not matter. What
   * does not exist is an error, except that no walk touches the cells of a connection that has none.
   * They only matter if NumberOfOutputWalks is not 0. Defaults -1, 0, 0.
   */
  vtkSetMacro(OutputWalksCell, vtkIdType);
  vtkGetMacro(OutputWalksCell, vtkIdType);
  vtkSetMacro(OutputWalksPort, int);
  vtkGetMacro(OutputWalksPort, int);
  vtkSetMacro(OutputWalksConnection, int);
  vtkGetMacro(OutputWalksConnection, int);
  ///@}

  ///@{
  /**
   * Output port 1. GetOutput(1) is null, as it is no vtkMultiBlockDataSet.
   */
  vtkPolyData* GetWalksOutput();
  vtkAlgorithmOutput* GetWalksOutputPort();
  ///@}

  ///@{
  /**
   * Figures of the last update, as in the field data of the output: W, those of three bands added up;
   * seconds; bytes. NaN, or -1 for counts, where the output has no such figure.
   */
  double GetEmittedPower();
  double GetAbsorbedPower();
  double GetEscapedPower();
  double GetStalePower();
  double GetReachedRelativeError();
  double GetShootSeconds();
  double GetVerifySeconds();
  double GetRepairSeconds();
  vtkIdType GetNumberOfShotWalks(); ///< the field `NumberOfWalks`
  vtkIdType GetNumberOfSegments();
  vtkIdType GetNumberOfInvalidWalks();
  vtkIdType GetNumberOfRepairedSegments();
  vtkIdType GetHistoryBytes();
  ///@}

  /// Includes the transforms and the interpolators.
  vtkMTimeType GetMTime() override;

protected:
  vtkIrradianceFilter();
  ~vtkIrradianceFilter() override;

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
  int CellEstimate = Sums;
  int NumberOfSpreadPhotons = 250;
  vtkTypeBool ComputeStandardError = 0;
  int NumberOfReplicates = 16;
  double TargetRelativeError = 0;
  vtkIdType MaximumNumberOfWalks = 10000000;
  double RepairTimeBudget = 0;
  vtkIdType NumberOfOutputWalks = 0;
  vtkIdType OutputWalksCell = -1;
  int OutputWalksPort = 0;
  int OutputWalksConnection = 0;

private:
  vtkIrradianceFilter(const vtkIrradianceFilter&) = delete;
  void operator=(const vtkIrradianceFilter&) = delete;

  vtkMTimeType OwnTime();
  vtkMTimeType InputTime();
  bool HasChangedMeanwhile();
  double Figure(const char* name);
  vtkIdType Count(const char* name);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
