#include "Pose.h"

#include "InputError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLinearTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"

#include <Eigen/SVD>

#include <sstream>

namespace irradiance
{

namespace
{

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix4 matrixOf(const std::string& where, vtkDataArray* array)
{
  const vtkIdType values = array->GetNumberOfValues();
  if (values != 16)
  {
    throw InputError(
      where + ": the field array ObjectToWorld has " + std::to_string(values) + " values, not 16");
  }
  Matrix4 matrix;
  const int components = array->GetNumberOfComponents();
  for (int i = 0; i < 16; ++i)
  {
    matrix(i / 4, i % 4) = array->GetComponent(i / components, i % components);
  }
  return matrix;
}

/// Areas are squares of it, and lengths of normals squares of these: all must be more than 0.
constexpr double kSmallestScale = 1e-30;

void checkInvertible(const std::string& where, const Matrix4& matrix)
{
  std::ostringstream message;
  message << where << ": the transform [" << matrix << "] ";
  if (!matrix.allFinite())
  {
    message << "is not finite";
    throw InputError(message.str());
  }
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
  {
    message << "is not affine: its last row is not 0 0 0 1";
    throw InputError(message.str());
  }
  const Eigen::JacobiSVD<Matrix3> svd(Matrix3(matrix.topLeftCorner<3, 3>()));
  if (!(svd.singularValues()[2] > 1e-14 * svd.singularValues()[0]))
  {
    message << "is singular";
    throw InputError(message.str());
  }
  if (!(svd.singularValues()[2] >= kSmallestScale))
  {
    message << "shrinks to less than " << kSmallestScale;
    throw InputError(message.str());
  }
}

}

AffineMap poseOf(const std::string& where, vtkLinearTransform* transform, vtkPolyData* input)
{
  vtkDataArray* array = input->GetFieldData()->GetArray("ObjectToWorld");
  Matrix4 matrix = Matrix4::Identity();
  if (transform)
  {
    transform->Update();
    matrix = Eigen::Map<const Matrix4>(transform->GetMatrix()->GetData());
  }
  else if (array)
  {
    matrix = matrixOf(where, array);
  }
  checkInvertible(where, matrix);
  return { matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>() };
}

}
