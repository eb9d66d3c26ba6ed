#ifndef irradiance_TriangleIntersection_h
#define irradiance_TriangleIntersection_h

#include "TriangleMesh.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

/**
 * The only ray/triangle test of the project: every traversal, every verification and brute force
 * call it, so that they agree bit for bit.
 *
 * After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013): the triangle is
 * sheared so that the ray becomes the z axis, and the origin is tested against three edge functions
 * in 2D. Two triangles that share an edge compute its function from the same two points with
 * opposite signs, so no ray slips between them. This needs products that are rounded on their own:
 * the file must be compiled without fused multiply-add (-ffp-contract=off).
 */
class ShearedRay
{
public:
  ShearedRay() = default;
  ShearedRay(const Vector3& origin, const Vector3& direction)
    : origin_(origin)
  {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (x_ + 1) % 3;
    if (direction[z_] < 0)
    {
      std::swap(x_, y_);
    }
    shearX_ = direction[x_] / direction[z_];
    shearY_ = direction[y_] / direction[z_];
    scaleZ_ = 1.0 / direction[z_];
  }

  /// True if the ray meets the closed triangle in front of its origin; then `distance` is set, and
  /// `weights`, when asked for, to the barycentric coordinates (not negative, sum about 1).
  bool meets(const Triangle& triangle, double& distance, Vector3* weights = nullptr) const
  {
    const Vector3 a = sheared(triangle.a), b = sheared(triangle.b), c = sheared(triangle.c);
    const double u = c[0] * b[1] - c[1] * b[0];
    const double v = a[0] * c[1] - a[1] * c[0];
    const double w = b[0] * a[1] - b[1] * a[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
    {
      return false;
    }
    // A triangle seen edge-on has a silhouette of width zero up to rounding: where along it the ray
    // passes is noise, so such a meeting does not count. Zero-area triangles end here as well.
    const double determinant = u + v + w;
    const double spread =
      std::max({ a.head<2>().squaredNorm(), b.head<2>().squaredNorm(), c.head<2>().squaredNorm() });
    if (!(std::abs(determinant) > kEdgeOn * spread))
    {
      return false;
    }
    distance = (u * a[2] + v * b[2] + w * c[2]) / determinant * scaleZ_;
    if (weights)
    {
      *weights = Vector3(u, v, w) / determinant;
    }
    return distance > 0;
  }

private:
  static constexpr double kEdgeOn = 0x1p-40;

  Vector3 sheared(const Vector3& point) const
  {
    const double z = point[z_] - origin_[z_];
    return { (point[x_] - origin_[x_]) - shearX_ * z, (point[y_] - origin_[y_]) - shearY_ * z, z };
  }

  Vector3 origin_;
  int x_, y_, z_;
  double shearX_, shearY_, scaleZ_;
};

}

#endif
