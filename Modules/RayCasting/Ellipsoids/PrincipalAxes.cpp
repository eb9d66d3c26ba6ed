// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/PrincipalAxes.h"

#include <utility>

namespace irradiance
{
namespace
{

/// Makes two columns orthogonal by a Jacobi rotation; false if they are orthogonal already.
bool orthogonalize(Matrix3& columns, int p, int q)
{
  constexpr double kNegligible = 0x1p-51 * 0x1p-51; // squared cosine
  const double product = columns.col(p).dot(columns.col(q));
  const double squareP = columns.col(p).squaredNorm();
  const double squareQ = columns.col(q).squaredNorm();
  if (!(product * product > kNegligible * squareP * squareQ))
  {
    return false;
  }
  const double cotangent = (squareQ - squareP) / (2.0 * product); // of twice the angle
  const double tangent =
    std::copysign(1.0, cotangent) / (std::abs(cotangent) + std::sqrt(1.0 + cotangent * cotangent));
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const Vector3 turned = cosine * (columns.col(p) - tangent * columns.col(q));
  columns.col(q) = cosine * (columns.col(q) + tangent * columns.col(p));
  columns.col(p) = turned;
  return true;
}

void sortLongestFirst(Matrix3& columns)
{
  for (const auto& [p, q] : { std::pair(0, 1), std::pair(1, 2), std::pair(0, 1) })
  {
    if (columns.col(p).squaredNorm() < columns.col(q).squaredNorm())
    {
      columns.col(p).swap(columns.col(q));
    }
  }
}

}

// One-sided Jacobi iteration (Hestenes 1958). An eigenvalue solver works on squares, in which the
// short axes of a needle would drown.
Matrix3 principalSemiAxes(const Matrix3& matrix)
{
  // A power of two near the largest entry keeps fourth powers in range.
  const double largest = matrix.cwiseAbs().maxCoeff();
  const double scale = largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
  Matrix3 columns = matrix / scale;
  constexpr int kMaxSweeps = 20; // about five are needed
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep)
  {
    sortLongestFirst(columns); // speeds up convergence
    bool isOrthogonal = true;
    for (const auto& [p, q] : { std::pair(0, 1), std::pair(0, 2), std::pair(1, 2) })
    {
      isOrthogonal = !orthogonalize(columns, p, q) && isOrthogonal;
    }
    if (isOrthogonal)
    {
      break;
    }
  }
  sortLongestFirst(columns);
  return columns * scale;
}

}
