// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Progress/CancelPoint.h"
#include "Progress/InputError.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace irradiance
{

/// A pose at a time.
struct KeyFrame
{
  std::string name; ///< for messages, as in "line 3 of poses.csv"
  double time = 0;
  AffineMap worldFromObject;
};

/// How poses between keys follow from them.
enum class KeyInterpolation
{
  Linear, ///< straight lines, constant speeds; rotations by the shorter way
  Spline, ///< cubic, through the keys with continuous velocity
  Step    ///< the pose of the last key
};

/// Poses over time. At the time of a key they are the pose of the key, bit for bit.
class KeyFrames
{
public:
  /// No keys.
  KeyFrames() = default;
  /// At least two keys, in the order of time. Throws InputError, naming the key and the value: for
  /// times that are not finite or not increasing, and for poses that cannot be interpolated, as
  /// they shear, or as some mirror and others do not.
  KeyFrames(
    std::vector<KeyFrame> keys, KeyInterpolation interpolation, const CancelPoint& cancelPoint)
    : interpolation_(interpolation)
    , keys_(std::move(keys))
  {
    checkTimes(keys_);
    if (interpolation == KeyInterpolation::Step)
    {
      return;
    }
    ThrottledCancelPoint pace(cancelPoint);
    for (const KeyFrame& key : keys_)
    {
      pace.step();
      onlyMove_ = onlyMove_ && key.worldFromObject.linear == keys_.front().worldFromObject.linear;
      parts_.push_back(partsOf(key));
      Parts& now = parts_.back();
      if (parts_.size() == 1)
      {
        continue;
      }
      const Parts& before = parts_[parts_.size() - 2];
      throwIf((now.scale[0] < 0) != (before.scale[0] < 0), key.name,
        now.scale[0] < 0 ? ": the pose mirrors" : ": the pose does not mirror",
        ", unlike the one before: between them it would be flat");
      if (now.rotation.dot(before.rotation) < 0)
      {
        now.rotation.coeffs() *= -1; // the same rotation, by the shorter way
      }
    }
  }

  bool isEmpty() const { return keys_.empty(); }
  double begin() const { return keys_.front().time; }
  double end() const { return keys_.back().time; }
  /// The times of the keys, and between them others at equal distances, none longer than 1 /
  /// `parts` of the time from begin() to end(). 0: the keys alone.
  std::vector<double> steps(int parts) const
  {
    const double longest =
      parts > 0 ? (end() - begin()) / parts : std::numeric_limits<double>::infinity();
    constexpr double kRounding = 1e-9; // or a quotient just above 4 would give five intervals
    std::vector<double> steps;
    for (std::size_t i = 0; i + 1 < keys_.size(); ++i)
    {
      const double from = keys_[i].time, length = keys_[i + 1].time - from;
      const double count = std::max(1.0, std::ceil(length / longest - kRounding));
      steps.push_back(from);
      for (int step = 1; step < count; ++step)
      {
        steps.push_back(from + length * (step / count));
      }
    }
    steps.push_back(end());
    return steps;
  }
  /// `time` is from begin() to end().
  AffineMap at(double time) const
  {
    const auto after = std::upper_bound(
      keys_.begin(), keys_.end(), time, [](double t, const KeyFrame& key) { return t < key.time; });
    const auto i = static_cast<std::size_t>(after - keys_.begin()) - 1; // the last key before
    const KeyFrame& key = keys_[i];
    if (time == key.time || interpolation_ == KeyInterpolation::Step)
    {
      return key.worldFromObject;
    }
    const double fraction = (time - key.time) / (keys_[i + 1].time - key.time);
    const Parts parts =
      interpolation_ == KeyInterpolation::Spline ? spline(i, fraction) : linear(i, fraction);
    const Matrix3& before = key.worldFromObject.linear;
    // What only moves keeps its rotation, bit for bit.
    const bool onlyMoves = interpolation_ == KeyInterpolation::Linear
      ? before == keys_[i + 1].worldFromObject.linear
      : onlyMove_;
    return { onlyMoves ? before : parts.rotation.toRotationMatrix() * parts.scale.asDiagonal(),
      parts.position };
  }

private:
  using Quaterniond = Eigen::Quaterniond;
  /// Columns of a pose may be this far from right angles (cosine), as files have few digits.
  static constexpr double kLargestShear = 1e-5;
  /// The rotation vector (axis times angle) of the shorter way.
  static Vector3 logOf(Quaterniond rotation)
  {
    if (rotation.w() < 0)
    {
      rotation.coeffs() *= -1;
    }
    const double sine = rotation.vec().norm();
    return sine > 0 ? Vector3(2 * std::atan2(sine, rotation.w()) / sine * rotation.vec())
                    : Vector3::Zero();
  }
  static Quaterniond expOf(const Vector3& rotationVector)
  {
    const double angle = rotationVector.norm();
    return angle > 0 ? Quaterniond(Eigen::AngleAxisd(angle, rotationVector / angle))
                     : Quaterniond::Identity();
  }
  static void checkTimes(const std::vector<KeyFrame>& keys)
  {
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
      const KeyFrame &key = keys[i], &before = keys[i > 0 ? i - 1 : 0];
      throwIf(!std::isfinite(key.time), key.name, ": the time ", key.time, " is not finite");
      throwIf(i > 0 && !(key.time > before.time), key.name, ": the time ", key.time,
        " is not after that of ", before.name, ", which is ", before.time);
    }
  }
  /// A pose in parts that can be interpolated: first scale, then rotate, then move.
  struct Parts
  {
    Vector3 position;
    Quaterniond rotation;
    Vector3 scale; ///< all negative if the pose mirrors
  };

  static Parts partsOf(const KeyFrame& key)
  {
    const Matrix3& linear = key.worldFromObject.linear;
    Parts parts{ key.worldFromObject.translation, Quaterniond::Identity(),
      linear.colwise().norm().transpose() };
    Matrix3 axes = linear * parts.scale.cwiseInverse().asDiagonal();
    const double shear = std::max({ std::abs(axes.col(0).dot(axes.col(1))),
      std::abs(axes.col(1).dot(axes.col(2))), std::abs(axes.col(2).dot(axes.col(0))) });
    throwIf(!(shear <= kLargestShear), key.name,
      ": the pose shears (two axes of the object meet at a cosine of ", shear,
      "), so it is not clear what lies between keys; InterpolationType Step takes it");
    if (axes.determinant() < 0)
    {
      parts.scale = -parts.scale;
      axes = -axes;
    }
    parts.rotation = Quaterniond(axes).normalized();
    return parts;
  }
  Parts linear(std::size_t i, double fraction) const
  {
    const Parts &a = parts_[i], &b = parts_[i + 1];
    return { a.position + fraction * (b.position - a.position),
      a.rotation.slerp(fraction, b.rotation), a.scale + fraction * (b.scale - a.scale) };
  }
  /// Cubic pieces with the slopes of Catmull and Rom: at a key the slope of the parabola through it
  /// and its neighbours, at the ends the slope of the straight line. Rotations: by rotation vectors
  /// relative to the first key of the piece, which agree at the keys.
  Parts spline(std::size_t i, double fraction) const
  {
    // The weights of the second key and of the slopes in a cubic (Hermite) over an interval of length
    // 1.
    const double u = fraction, v = 1 - u;
    const double to = (1 + 2 * v) * u * u, fromSlope = u * v * v, toSlope = -u * u * v;
    const double length = keys_[i + 1].time - keys_[i].time;
    const Quaterniond base = parts_[i].rotation;
    // The slope of a quantity at key k, times `length`. `step(a, b)`: how far it goes from key a to
    // b.
    const auto slope = [&](std::size_t k, const auto& step) -> Vector3 {
      const auto speed = [&](std::size_t a) -> Vector3 {
        return step(a, a + 1) / (keys_[a + 1].time - keys_[a].time);
      };
      if (k == 0 || k + 1 == keys_.size())
      {
        return speed(k == 0 ? 0 : k - 1) * length;
      }
      const double before = keys_[k].time - keys_[k - 1].time;
      const double after = keys_[k + 1].time - keys_[k].time;
      return (speed(k - 1) * after + speed(k) * before) * (length / (before + after));
    };
    const auto cubic = [&](const auto& step) -> Vector3 {
      return to * step(i, i + 1) + fromSlope * slope(i, step) + toSlope * slope(i + 1, step);
    };
    const Vector3 moved = cubic([&](std::size_t a, std::size_t b) -> Vector3 {
      return parts_[b].position - parts_[a].position;
    });
    const Vector3 grown = cubic(
      [&](std::size_t a, std::size_t b) -> Vector3 { return parts_[b].scale - parts_[a].scale; });
    const Vector3 turned = cubic([&](std::size_t a, std::size_t b) -> Vector3 {
      return logOf(parts_[a].rotation.conjugate() * parts_[b].rotation);
    });
    return { parts_[i].position + moved, base * expOf(turned), parts_[i].scale + grown };
  }

  KeyInterpolation interpolation_ = KeyInterpolation::Linear;
  std::vector<KeyFrame> keys_;
  std::vector<Parts> parts_; ///< of each key; none if poses are not interpolated
  bool onlyMove_ = true;     ///< all keys have the same linear map
};

}
