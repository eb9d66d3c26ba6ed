// SPDX-License-Identifier: BSD-3-Clause
#include "Input/Pose.h"

#include "Progress/InputError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkNew.h"
#include "vtkTransform.h"

#include <Eigen/SVD>

#include <algorithm>

namespace irradiance
{

namespace
{

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix4 matrixOf(const std::string& where, vtkAbstractArray* anyArray)
{
  vtkDataArray* array = vtkDataArray::SafeDownCast(anyArray);
  throwIf(!array, where, ": the field array ", anyArray->GetName(), " is a ",
    anyArray->GetClassName(), ", not numbers");
  throwIf(array->GetNumberOfValues() != 16, where, ": the field array ", anyArray->GetName(),
    " has ", array->GetNumberOfValues(), " values, not 16");
  Matrix4 matrix;
  const int components = array->GetNumberOfComponents();
  for (int i = 0; i < 16; ++i)
  {
    matrix(i / 4, i % 4) = array->GetComponent(i / components, i % components);
  }
  return matrix;
}

AffineMap mapOf(const std::string& where, const Matrix4& matrix)
{
  // Areas scale with its square, and squared normals with its fourth power: all must stay above 0.
  constexpr double kSmallestScale = 1e-30;
  const auto failIf = [&](bool isWrong, const auto&... what) {
    throwIf(isWrong, where, ": the transform [", matrix, "] ", what...);
  };
  failIf(!matrix.allFinite(), "is not finite");
  failIf(
    matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1), "is not affine: its last row is not 0 0 0 1");
  const Eigen::JacobiSVD<Matrix3> svd(Matrix3(matrix.topLeftCorner<3, 3>()));
  failIf(!(svd.singularValues()[2] > 1e-14 * svd.singularValues()[0]), "is singular");
  failIf(!(svd.singularValues()[2] >= kSmallestScale), "shrinks to less than ", kSmallestScale);
  return { matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>() };
}

}

AffineMap poseOf(const std::string& where, vtkLinearTransform* transform)
{
  transform->Update();
  return poseOf(where, transform->GetMatrix()->GetData());
}

AffineMap poseOf(const std::string& where, const double* rowByRow)
{
  return mapOf(where, Eigen::Map<const Matrix4>(rowByRow));
}

std::array<double, 16> propMatrix(const double position[3], const double orientation[3])
{
  vtkNew<vtkTransform> transform;
  transform->Translate(position);
  transform->RotateZ(orientation[2]);
  transform->RotateX(orientation[0]);
  transform->RotateY(orientation[1]);
  std::array<double, 16> matrix;
  std::copy_n(transform->GetMatrix()->GetData(), matrix.size(), matrix.begin());
  return matrix;
}

AffineMap poseOf(const std::string& where, vtkFieldData* fields, const char* arrayName)
{
  vtkAbstractArray* array = fields ? fields->GetAbstractArray(arrayName) : nullptr;
  return array ? mapOf(where, matrixOf(where, array)) : AffineMap();
}

bool hasFieldPose(vtkFieldData* fields)
{
  vtkAbstractArray* array = fields ? fields->GetAbstractArray(kFieldPoseName) : nullptr;
  const bool isMatrix = vtkDataArray::SafeDownCast(array) && array->GetNumberOfValues() == 16;
  return array && (!isMatrix || matrixOf("", array) != Matrix4::Identity());
}

vtkSmartPointer<vtkLinearTransform> transformOf(const double elements[16])
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(elements);
  auto transform = vtkSmartPointer<vtkMatrixToLinearTransform>::New();
  transform->SetInput(matrix);
  return transform;
}

std::array<double, 16> matrixOf(const AffineMap& map)
{
  std::array<double, 16> rowByRow;
  Eigen::Map<Matrix4> matrix(rowByRow.data());
  matrix << map.linear, map.translation, 0, 0, 0, 1;
  return rowByRow;
}

AffineMap checkedPose(const std::string& where, const AffineMap& map)
{
  return poseOf(where, matrixOf(map).data());
}

AffineMap composed(const AffineMap& outer, const AffineMap& inner)
{
  return outer == AffineMap() ? inner
    : inner == AffineMap()    ? outer
                              : AffineMap{ outer.linear * inner.linear, outer(inner.translation) };
}

}
