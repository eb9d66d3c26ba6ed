// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkKeyFramedPose
 * @brief   a pose over time for polydata, or a tree of them, from key frames
 *
 * Passes its input on, with the pose at the requested time (UPDATE_TIME_STEP; without one: the pose
 * of the first key) as the field-data array `ObjectToWorld`: 16 doubles, row by row, as port 1 of
 * vtkIrradianceFilter reads it. Points, cells and arrays are the input's own, so that filter
 * builds no tree again. To see the motion without it, apply the array (vtkTransformPolyDataFilter).
 *
 * The keys, two at least, come from AddPose() and AddPoseMatrix(), in any order, or from a file. At
 * the time of a key the output has exactly its pose. If the input has an `ObjectToWorld` of its
 * own, that is applied first: world = pose * input's.
 *
 * Composite data (vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection)
 * keep their structure and the names of their blocks. All leaves have to be vtkPolyData; empty ones
 * stay empty. The pose stands in the field data of each leaf: world = pose * the tree's own * the
 * leaf's own; the tree's own is not passed on.
 *
 * TIME_STEPS of the output: the times of the keys, NumberOfTimeSteps between them, and the steps of
 * the input. TIME_RANGE: from the first to the last of them, and the input's. Progress is reported
 * while poses are read. AbortExecute is honoured; then the output is empty.
 *
 * @section File
 * Comma-separated values. The first line names the columns, in any order; other columns are passed
 * over, as are empty lines and those that begin with #. The times have to increase.
 * - `time`, in the unit of the pipeline's time, and
 * - `x`, `y`, `z` (m) with or without a rotation: `rx`, `ry`, `rz` (degrees, as AddPose()), or the
 *   quaternion `qw`, `qx`, `qy`, `qz`; or
 * - `m00`, `m01`, ... `m33`: the matrix, row by row; the last row may be left out.
 *
 * @section PoseErrors Errors
 * A file that cannot be read, columns that are missing or of two kinds, a value that is not a
 * finite number, times of a file that do not increase, two keys of one time, fewer than two keys,
 * poses that are singular, and poses that cannot be interpolated: one error that names the file and
 * the line, or the number of the pose, and the value; the output is empty. So it is with input, or
 * a leaf of it, that is no vtkPolyData. A time outside of the keys: see OutsideOfKeys.
 */

#ifndef vtkKeyFramedPose_h
#define vtkKeyFramedPose_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // For the internals

class vtkMatrix4x4;
class vtkPolyData;

class VTKFILTERSIRRADIANCE_EXPORT vtkKeyFramedPose : public vtkPassInputTypeAlgorithm
{
public:
  static vtkKeyFramedPose* New();
  vtkTypeMacro(vtkKeyFramedPose, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the pose between two keys follows from the keys.
  enum InterpolationTypes
  {
    Linear = 0, ///< at constant speed; rotations about one axis, by the shorter way
    Spline = 1, ///< through the keys without jumps of speed: cubic pieces (Catmull and Rom)
    Step = 2    ///< the pose of the last key
  };

  /// What happens at a time before the first key or after the last.
  enum OutsideModes
  {
    Error = 0, ///< an error
    Hold = 1,  ///< the pose of the nearest key
    Leave = 2  ///< the part is not there: the output has its arrays, but no points and no cells
  };

  /// @{
  /**
   * Adds a key: at this time the object's origin is at (x, y, z), m, and it is turned by (rx, ry,
   * rz), degrees, as vtkProp3D: about its y axis first, then x, then z. Rotations go the shorter
   * way from key to key: keys of what spins have to be less than 180 degrees apart.
   */
  void AddPose(double time, double x, double y, double z, double rx, double ry, double rz);
  void AddPose(double time, const double position[3], const double orientation[3]);
  /// @}

  /// @{
  /**
   * Adds a key by its matrix, model to world, row by row: an invertible affine map. Linear and
   * Spline interpolate position, rotation and scale; they take no matrix that shears, and either
   * all mirror or none does. Step takes all.
   */
  void AddPoseMatrix(double time, double m00, double m01, double m02, double m03, double m10,
    double m11, double m12, double m13, double m20, double m21, double m22, double m23, double m30,
    double m31, double m32, double m33);
  void AddPoseMatrix(double time, const double matrix[16]);
  void AddPoseMatrix(double time, vtkMatrix4x4* matrix);
  /// @}

  /// Removes all poses that were added; a file is not concerned.
  void RemoveAllPoses();
  /// The number of poses that were added.
  int GetNumberOfPoses();

  /// @{
  /**
   * A file of times and poses (.csv), see above; null or empty: none. It excludes poses that are
   * added. It is read again after Modified(). Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  /// @}

  /// @{
  /** See InterpolationTypes. Default Linear. */
  vtkSetClampMacro(InterpolationType, int, Linear, Step);
  vtkGetMacro(InterpolationType, int);
  void SetInterpolationTypeToLinear() { this->SetInterpolationType(Linear); }
  void SetInterpolationTypeToSpline() { this->SetInterpolationType(Spline); }
  void SetInterpolationTypeToStep() { this->SetInterpolationType(Step); }
  /// @}

  /// @{
  /** See OutsideModes. Default Error. */
  vtkSetClampMacro(OutsideOfKeys, int, Error, Leave);
  vtkGetMacro(OutsideOfKeys, int);
  void SetOutsideOfKeysToError() { this->SetOutsideOfKeys(Error); }
  void SetOutsideOfKeysToHold() { this->SetOutsideOfKeys(Hold); }
  void SetOutsideOfKeysToLeave() { this->SetOutsideOfKeys(Leave); }
  /// @}

  /// @{
  /**
   * How finely TIME_STEPS divide the time from the first key to the last, for what takes one step
   * after the other: each interval between two keys is cut into equal ones, no longer than 1 /
   * NumberOfTimeSteps of it all. The steps of several poses in a scene are united: with many parts
   * choose fewer each. 0: the keys alone. Poses do not depend on it. 0 to 1,000,000. Default 100.
   */
  vtkSetClampMacro(NumberOfTimeSteps, int, 0, 1000000);
  vtkGetMacro(NumberOfTimeSteps, int);
  /// @}

  /// The output if the input is polydata, else null; GetOutputDataObject(0) is any of them.
  vtkPolyData* GetOutput();

protected:
  vtkKeyFramedPose();
  ~vtkKeyFramedPose() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;
  int InterpolationType = Linear;
  int OutsideOfKeys = Error;
  int NumberOfTimeSteps = 100;

private:
  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
