// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleInSphere.h"
#include "Photons/Foot.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

/**
 * The surface of an object as a sensor sees it: which of its sides count, for photons and for area
 * alike. A side of a triangle counts if
 * - it faces as the sensor does, see Facing;
 * - it is inside of a body if the sensor's foot is, and outside if that is;
 * - the nearest point of the triangle is not in front of the plane of the foot while the foot is
 *   behind the plane of the triangle, or the other way round. So it is with sheets above and below,
 *   and with steps. Surface that bends has both in front, or both behind. What is in the plane but
 *   for a thousandth of the distance counts.
 */
class SeenSurface
{
public:
  /// All of them must outlive it.
  SeenSurface(const SceneObject& object, const SurfaceTree& surface, const PlacedTree& placed,
    const Foot& foot)
    : object_(object)
    , surface_(surface)
    , placed_(placed)
    , foot_(foot)
    , facing_(placed.facing(foot.sensor))
    , fromFoot_{ object.worldFromObject.linear,
      object.worldFromObject.translation - foot.sensor.position }
    , flattened_{ foot.sensor.flattening() * fromFoot_.linear,
      foot.sensor.flattening() * fromFoot_.translation }
    , upward_(object.worldFromObject.linear.transpose() * foot.normal)
    , height_(foot.normal.dot(fromFoot_.translation))
    , blur_(kBlur * (foot.size + placed.size()) + kRounding * foot.sensor.position.norm())
  {
    position_ = placed.unitPoint(foot.sensor.position);
    if (placed.keepsAngles())
    {
      toLight_ = placed.unitDirection(foot.sensor.normal);
      normal_ = placed.unitDirection(foot.normal);
    }
  }

  /// 1: the front of the triangle counts; -1: the back; 0: neither.
  int side(std::uint32_t triangle) const
  {
    const Triangle& model = object_.body->mesh()[triangle];
    const Vector3 front = facing_.areaVector(model);
    const int side = facing_.side(front);
    if (side == 0 ||
      isInside(surface_.solidSide(triangle), side, placed_.isMirrored()) != foot_.isInside)
    {
      return 0;
    }
    // Most triangles are in the plane of the foot.
    const auto isInPlane = [&](const Vector3& corner) {
      return std::abs(upward_.dot(corner) + height_) < blur_;
    };
    if (isInPlane(model.a) && isInPlane(model.b) && isInPlane(model.c))
    {
      return side;
    }
    const Vector3 closest = closestPoint(transformed(fromFoot_, model));
    return isOtherSurface(side * front.normalized(), closest) ? 0 : side;
  }
  /// The world area of what counts within a sphere around the foot in the flattened world.
  double areaWithin(double radius) const
  {
    return object_.isEmpty() || surface_.isEmpty() ? 0.0 : areaOf(0, radius);
  }

private:
  /// Of the sizes of both objects: pays for points in floats.
  static constexpr double kBlur = 0x1p-20;
  /// Of coordinates.
  static constexpr double kRounding = 0x1p-48;
  /// Of the distance: pays for planes of small triangles that are a little aslant, as points are in
  /// floats.
  static constexpr double kAslant = 0x1p-10;
  struct Range
  {
    double lower, upper;
  };
  /// Of heights along a unit vector of the points of a node, whose center has a height.
  static Range heights(const SurfaceNode& node, const Vector3& along, double ofCenter)
  {
    const double with = std::abs(along.dot(node.axis));
    const double reach = with * node.thickness + along.cross(node.axis).norm() * node.radius;
    return { ofCenter - reach, ofCenter + reach };
  }
  bool isOtherSurface(const Vector3& normal, const Vector3& closest) const
  {
    const double blur = blur_ + kAslant * closest.norm();
    const double itsHeight = foot_.normal.dot(closest), ours = -normal.dot(closest);
    return (itsHeight > blur && ours < -blur) || (itsHeight < -blur && ours > blur);
  }
  double areaOf(std::size_t number, double radius) const
  {
    const SurfaceNode& node = surface_.node(number);
    const Share share = shareOf(node, radius);
    if (share != Share::Some)
    {
      const double unit = placed_.worldUnitsPerUnit();
      return share == Share::All ? node.area * (unit * unit) : 0.0;
    }
    if (!node.isLeaf())
    {
      return areaOf(number + 1, radius) + areaOf(node.right, radius);
    }
    double area = 0;
    for (std::uint32_t i = node.begin; i < node.end; ++i)
    {
      area += areaOfTriangle(surface_.order()[i], radius);
    }
    return area;
  }
  double areaOfTriangle(std::uint32_t triangle, double radius) const
  {
    const Triangle& model = object_.body->mesh()[triangle];
    const Triangle flat = transformed(flattened_, model);
    const double inside = areaInSphere(flat, radius);
    // A plane map keeps the ratios of areas.
    return inside > 0 && side(triangle) != 0
      ? inside / flat.area() * transformed(fromFoot_, model).area()
      : 0.0;
  }
  /// Where poses do not keep angles, nothing is known of nodes but how near they are.
  Share shareOf(const SurfaceNode& node, double radius) const
  {
    if (!placed_.keepsAngles())
    {
      return placed_.distanceAtLeast(node, position_) > radius ? Share::None : Share::Some;
    }
    const Vector3 away = node.center - position_;
    const Share near = within(node, away, radius / placed_.worldUnitsPerUnit());
    if (near == Share::None)
    {
      return near;
    }
    const Share facing = this->facing(node);
    const Share same = facing == Share::All ? onSameSurface(node, away) : Share::Some;
    if (facing == Share::None || same == Share::None)
    {
      return Share::None;
    }
    return near == Share::All && same == Share::All ? Share::All : Share::Some;
  }
  Share within(const SurfaceNode& node, const Vector3& away, double radius) const
  {
    constexpr double kMore = Sensor::kFlattening * Sensor::kFlattening - 1;
    constexpr double kSlack = 0x1p-40;
    const double distance = away.norm();
    const Range across = heights(node, toLight_, toLight_.dot(away));
    const double leastAcross = std::max({ across.lower, -across.upper, 0.0 });
    const double mostAcross = std::max(across.upper, -across.lower);
    const double least = std::max(distance - node.radius, 0.0), most = distance + node.radius;
    const double squared = radius * radius;
    if (least * least + kMore * leastAcross * leastAcross > squared * (1 + kSlack) + kSlack)
    {
      return Share::None;
    }
    return most * most + kMore * mostAcross * mostAcross <= squared ? Share::All : Share::Some;
  }
  /// And inside of a body or outside, as the foot.
  Share facing(const SurfaceNode& node) const
  {
    const Share share = facingShare(node, toLight_);
    if (share != Share::All)
    {
      return share;
    }
    const SolidSide ours = toLight_.dot(node.axis) > 0 ? SolidSide::InFront : SolidSide::Behind;
    const bool hasInside = (node.solidSides & SurfaceNode::maskOf(ours)) != 0;
    const bool hasOutside = (node.solidSides & ~SurfaceNode::maskOf(ours)) != 0;
    return !(foot_.isInside ? hasInside : hasOutside) ? Share::None
      : hasInside && hasOutside                       ? Share::Some
                                                      : Share::All;
  }
  /// What isOtherSurface() says of all triangles, which face as the sensor does.
  Share onSameSurface(const SurfaceNode& node, const Vector3& away) const
  {
    const double distance = away.norm(), blur = blur_ / placed_.worldUnitsPerUnit();
    const double leastBlur = blur + kAslant * std::max(distance - node.radius, 0.0);
    const double mostBlur = blur + kAslant * (distance + node.radius);
    const Vector3 axis = toLight_.dot(node.axis) > 0 ? node.axis : Vector3(-node.axis);
    const Range its = heights(node, normal_, normal_.dot(away));
    // The normals of triangles are up to `sine` off the axis.
    const double turned = (node.sine + 1 - node.cosine) * (distance + node.radius);
    const double middle = -axis.dot(away), reach = node.thickness + turned;
    const Range ours{ middle - reach, middle + reach };
    if ((its.lower > mostBlur && ours.upper < -mostBlur) ||
      (its.upper < -mostBlur && ours.lower > mostBlur))
    {
      return Share::None;
    }
    const auto isIn = [&](const Range& range) {
      return range.lower > -leastBlur && range.upper < leastBlur;
    };
    const bool areBothAbove = its.lower > -leastBlur && ours.lower > -leastBlur;
    const bool areBothBelow = its.upper < leastBlur && ours.upper < leastBlur;
    return areBothAbove || areBothBelow || isIn(its) || isIn(ours) ? Share::All : Share::Some;
  }

  const SceneObject& object_;
  const SurfaceTree& surface_;
  const PlacedTree& placed_;
  const Foot& foot_;
  Facing facing_;
  AffineMap fromFoot_, flattened_; ///< from the object's space; the foot is the origin
  /// The height above the plane of the foot, world, is upward_ . (point in the object's space) +
  /// height_.
  Vector3 upward_;
  double height_;
  double blur_; ///< heights above a plane that mean nothing, world
  // The foot in the unit frame of the surface, directions only where the pose keeps angles.
  Vector3 position_, toLight_, normal_;
};

}
