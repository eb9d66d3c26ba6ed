// SPDX-License-Identifier: BSD-3-Clause
#include "CameraRays.h"

#include <cmath>

namespace pathtracedroom
{

CameraRays::CameraRays(const View& view)
  : width_(view.width)
  , height_(view.height)
  , pixel_(2 * std::tan(view.angle / 2) / view.height)
  , rightward_(view.forward.cross(view.up).normalized())
  , upward_(rightward_.cross(view.forward).normalized())
{
  pinhole_.shape = PathVertex::Shape::Pixel;
  pinhole_.position = pinhole_.clearPosition = view.position;
  pinhole_.normal = view.forward.normalized();
  pinhole_.diffuseChance = 1 / (pixel_ * pixel_);
  pinhole_.diffuse = Spectrum::Constant(pinhole_.diffuseChance);
}

std::size_t CameraRays::numberOfBins() const
{
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

irradiance::Box CameraRays::pointBounds() const
{
  return { pinhole_.position, pinhole_.position };
}

Departure CameraRays::start(std::size_t bin, Random& random) const
{
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t column = bin % width, row = bin / width;
  const auto [u, v] = random.nextPair();
  const double x = static_cast<double>(column) + u - 0.5 * width_;
  const double y = static_cast<double>(row) + v - 0.5 * height_;
  const Vector3 through = pinhole_.normal + pixel_ * (x * rightward_ + y * upward_);
  return { pinhole_, through.normalized() };
}

std::optional<Sensor::Place> CameraRays::placeOf(const PathVertex& lightVertex) const
{
  const Vector3 seen = lightVertex.position - pinhole_.position;
  const double depth = seen.dot(pinhole_.normal);
  if (!(depth > 0))
  {
    return {};
  }
  const double x = std::floor(seen.dot(rightward_) / (depth * pixel_) + 0.5 * width_);
  const double y = std::floor(seen.dot(upward_) / (depth * pixel_) + 0.5 * height_);
  if (!(x >= 0 && x < width_ && y >= 0 && y < height_))
  {
    return {};
  }
  return Place{ static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
      static_cast<std::size_t>(x),
    pinhole_ };
}

}
