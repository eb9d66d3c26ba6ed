// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/DistantLight.h"

#include "Sampling/ElementaryFunctions.h"
#include "Sampling/SobolPoint.h"

namespace irradiance
{

namespace
{

/// From east, north and up, to the coordinates of DirectionTable, and back: this is its own inverse.
Vector3 swapped(const Vector3& direction)
{
  return { direction[1], direction[0], direction[2] };
}

/// Degrees in steps of at most `widest`, with those that are given, and quarters of a turn between.
std::vector<double> refined(std::vector<double> angles, double widest)
{
  for (int number = -7; number <= 7; ++number)
  {
    const double quarter = 90.0 * number;
    const auto place = std::lower_bound(angles.begin(), angles.end(), quarter);
    if (place != angles.begin() && place != angles.end() && *place != quarter)
    {
      angles.insert(place, quarter);
    }
  }
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
  {
    const double width = angles[i + 1] - angles[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(width / widest)));
    for (int step = 0; step < steps; ++step)
    {
      fine.push_back(angles[i] + step * width / steps);
    }
  }
  fine.push_back(angles.back());
  return fine;
}

}

/// The area of the box as it is seen has bends at the quarters of a turn, and is no linear function
/// of the angles between.
DistantLight::DistantLight(const Sky& sky)
  : lit_(sky.lit)
{
  constexpr double kWidest = 2.5; // degrees
  const DirectionTable radiance(sky.polarAngles, sky.azimuths, sky.radiance);
  const bool isRound = sky.azimuths.size() == 1;
  const std::vector<double> polar = refined(sky.polarAngles, kWidest);
  const std::vector<double> azimuths =
    refined(isRound ? std::vector<double>{ 0, 360 } : sky.azimuths, kWidest);
  std::vector<double> values;
  for (const double azimuth : azimuths)
  {
    for (std::size_t i = 0; i < polar.size(); ++i)
    {
      // An angle that is given twice has the values of both sides.
      const bool isSecond = i > 0 && polar[i] == polar[i - 1];
      const double angle = polar[i], a = azimuth * kPi / 180;
      const double degree = kPi / 180, sine = std::sin(angle * degree);
      const Vector3 local(sine * std::cos(a), sine * std::sin(a), std::cos(angle * degree));
      const double side = isSecond ? 1 : -1;
      values.push_back(radiance.valueAt(angle * degree, a, side) * crossSection(swapped(local)));
    }
  }
  table_ = std::make_shared<const DirectionTable>(polar, azimuths, std::move(values));
  parts_ = std::make_shared<const std::vector<Part>>(partsOfSky());
}

DistantLight DistantLight::sunOf(const Sky& sky)
{
  DistantLight sun;
  sun.lit_ = sky.lit;
  sun.axis_ = sky.towardsSun;
  sun.cosine_ = std::cos(sky.sunRadius);
  constexpr int kAcross = 32, kAround = 256; // the box as it is seen has bends
  for (int i = 0; i < kAcross * kAround; ++i)
  {
    const int row = i / kAround;
    const double across = (row + 0.5) / kAcross, around = (i % kAround + 0.5) / kAround;
    sun.meanCrossSection_ += sun.crossSection(sun.inDisc({ across, around })) / (kAcross * kAround);
  }
  const Part disc{ 1, sun.cosine_, 0, 2 * kPi, sun.axis_, sky.sunRadius, 1 };
  sun.parts_ = std::make_shared<const std::vector<Part>>(1, disc);
  return sun;
}

/// Of about the same solid angle, and above or below the horizon. What lies at the border of parts
/// counts for all of them: none that has light may be without a share.
std::vector<DistantLight::Part> DistantLight::partsOfSky() const
{
  constexpr int kRows = 16; // from pole to pole
  constexpr double kHeight = kPi / kRows;
  std::vector<Part> parts;
  std::array<int, kRows + 1> starts{}; // of rows in these
  for (int row = 0; row < kRows; ++row)
  {
    const double upper = std::cos(row * kHeight),
                 lower = 2 * row + 2 == kRows ? 0 : std::cos((row + 1) * kHeight);
    const int columns =
      std::max(4, static_cast<int>(std::round(2 * kPi * (upper - lower) / (kHeight * kHeight))));
    for (int column = 0; column < columns; ++column)
    {
      Part part{ upper, lower, 2 * kPi * column / columns, 2 * kPi * (column + 1) / columns,
        Vector3::Zero(), 0, 0 };
      part.middle = sample(part, { 0.5, 0.5 }).direction;
      for (const double end : { 0.0, 1.0 })
      {
        const double cosine = part.middle.dot(sample(part, { end, 1 }).direction);
        part.radius = std::max(part.radius, std::acos(std::clamp(cosine, -1.0, 1.0)));
      }
      parts.push_back(part);
    }
    starts[row + 1] = static_cast<int>(parts.size());
  }
  std::vector<int> touched;
  table_->forEachPart([&](const Vector3& local, double weight) {
    constexpr double kHalf = kPi / 360; // of what is widest
    const double polar = std::acos(std::clamp(local[2], -1.0, 1.0)),
                 azimuth = std::atan2(local[1], local[0]);
    const auto placeOf = [](double angle, double width) {
      return static_cast<int>(std::floor(angle / width));
    };
    const int first = placeOf(std::max(0.0, polar - kHalf), kHeight),
              last = placeOf(polar + kHalf, kHeight);
    touched.clear();
    for (int row = first; row <= std::min(last, kRows - 1); ++row)
    {
      const int columns = starts[row + 1] - starts[row];
      const double width = 2 * kPi / columns;
      const bool isAlike = (2 * row < kRows) == (local[2] > 0);
      for (int i = placeOf(azimuth - kHalf, width); isAlike && i <= placeOf(azimuth + kHalf, width);
           ++i)
      {
        touched.push_back(starts[row] + (i + columns) % columns);
      }
    }
    for (const int part : touched)
    {
      parts[part].flux += weight / (table_->integral() * static_cast<double>(touched.size()));
    }
  });
  parts.erase(
    std::remove_if(parts.begin(), parts.end(), [](const Part& part) { return !(part.flux > 0); }),
    parts.end());
  return parts;
}

/// By rejection, which is rare: a disc is small.
Vector3 DistantLight::sampleDisc(std::array<double, 2> u) const
{
  const double radius = std::sqrt(1 - cosine_ * cosine_);
  const double most = crossSection((axis_.cwiseAbs().array() + radius).cwiseMin(1).matrix());
  constexpr int kMostTries = 64;
  for (int i = 0; i < kMostTries; ++i)
  {
    Vector3 direction = inDisc(u);
    if (otherSquare(u)[0] * most <= crossSection(direction))
    {
      return direction;
    }
    u = otherSquare({ u[1], u[0] });
  }
  return axis_;
}

DistantLight::Sample DistantLight::sample(const Part& part, const std::array<double, 2>& u) const
{
  if (!table_)
  {
    const Vector3 direction = inDisc(u);
    return { direction, part.solidAngle(), 1 / meanCrossSection_ };
  }
  const double height = part.upper - u[0] * (part.upper - part.lower),
               radius = std::sqrt(std::max(0.0, 1 - height * height)),
               azimuth = part.first + u[1] * (part.last - part.first);
  const SinCos around(azimuth / (2 * kPi));
  const Vector3 local(radius * around.cosine, radius * around.sine, height);
  const Vector3 direction = swapped(local);
  return { direction, part.solidAngle(),
    table_->valueAt(arcTangent(radius, height), azimuth, 1) / table_->integral() *
      part.solidAngle() / crossSection(direction) };
}

double DistantLight::radiancePerWatt(const Vector3& direction) const
{
  return table_->value(swapped(direction)) / (table_->integral() * crossSection(direction));
}

/// From one of the three faces of the box that are seen.
Ray DistantLight::leaving(
  const std::array<double, 2>& place, const std::array<double, 2>& direction) const
{
  const Vector3 from = table_ ? swapped(table_->sample(direction)) : sampleDisc(direction);
  const Vector3 size = lit_.extent();
  double rest = place[0] * crossSection(from);
  for (int axis = 0;; ++axis)
  {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double seen = std::abs(from[axis]) * size[next] * size[last];
    if (rest < seen || axis == 2)
    {
      Vector3 origin;
      origin[axis] = from[axis] > 0 ? lit_.upper[axis] : lit_.lower[axis];
      origin[next] = lit_.lower[next] + std::min(1.0, rest / seen) * size[next];
      origin[last] = lit_.lower[last] + place[1] * size[last];
      return { origin, -from, {} };
    }
    rest -= seen;
  }
}

}
