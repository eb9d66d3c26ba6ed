// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/DirectionTable.h"

#include "Progress/InputError.h"
#include "Sampling/ElementaryFunctions.h"
#include "Sampling/WeightChoice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiance
{

namespace
{

constexpr double kDegree = kPi / 180;
constexpr double kTurn = 360; // degrees

/// Throws InputError for the first number that is not as it has to be.
template <class IsRight>
void checkEach(const std::vector<double>& numbers, const char* what, const IsRight& isRight)
{
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    throwIf(!isRight(i), what, " number ", i, " is ", numbers[i]);
  }
}

/// The integral over a step of what is linear in the angle, times the sine: of `from`, and what it
/// grows by each radian. About the middle, where little cancels.
double overStep(double start, double width, double from, double growth)
{
  const double half = width / 2;
  const SinCos middle((start + half) / (2 * kPi)), ofHalf(half / (2 * kPi));
  return 2 * (from + growth * half) * middle.sine * ofHalf.sine +
    2 * growth * middle.cosine * (ofHalf.sine - half * ofHalf.cosine);
}

/// Where in a step the integral is a part of that over the whole step. Newton's method within
/// bounds, from where it would be if the sine were linear as well.
double placeInStep(double start, double width, double from, double growth, double part)
{
  const SinCos first(start / (2 * kPi)), last((start + width) / (2 * kPi));
  const double to = from + growth * width;
  const double whole =
    from * (first.cosine - last.cosine) + growth * (last.sine - first.sine - width * last.cosine);
  double lower = 0, upper = width,
         place = width * sampleLinear(part, from * first.sine, std::max(0.0, to * last.sine));
  constexpr int kMostSteps = 64;
  for (int i = 0; i < kMostSteps; ++i)
  {
    const SinCos here((start + place) / (2 * kPi));
    const double excess = from * (first.cosine - here.cosine) +
      growth * (here.sine - first.sine - place * here.cosine) - part * whole;
    (excess > 0 ? upper : lower) = place;
    const double slope = (from + growth * place) * here.sine;
    const double next = place - excess / slope;
    const double before =
      std::exchange(place, next > lower && next < upper ? next : (lower + upper) / 2);
    if (std::abs(place - before) <= 0x1p-16 * width) // the next step is about the square of it
    {
      break;
    }
  }
  return place;
}

/// The step of increasing angles on which an angle falls, the later one at a border. A guess, which
/// is right of even steps, and from there step by step.
std::size_t stepOf(const std::vector<double>& angles, double angle)
{
  const std::size_t last = angles.size() - 2;
  const double whole = angles.back() - angles.front();
  const double guess =
    whole > 0 ? (angle - angles.front()) / whole * static_cast<double>(last + 1) : 0;
  auto step = static_cast<std::size_t>(std::clamp(guess, 0.0, static_cast<double>(last)));
  while (step > 0 && angle < angles[step])
  {
    --step;
  }
  while (step < last && angle >= angles[step + 1])
  {
    ++step;
  }
  return step;
}

}

DirectionTable::DirectionTable(
  std::vector<double> polarAngles, std::vector<double> azimuths, std::vector<double> values)
  : polar_(std::move(polarAngles))
  , azimuths_(std::move(azimuths))
  , values_(std::move(values))
{
  throwIf(polar_.size() < 2, "there are ", polar_.size(), " polar angles; 2 or more are needed");
  throwIf(azimuths_.empty(), "there are no azimuths");
  checkEach(polar_, "polar angle", [&](std::size_t i) {
    return polar_[i] >= (i == 0 ? 0 : polar_[i - 1]) && polar_[i] <= kTurn / 2;
  });
  checkEach(azimuths_, "azimuth", [&](std::size_t i) {
    return std::abs(azimuths_[i]) <= 2 * kTurn &&
      (i == 0 || (azimuths_[i] > azimuths_[i - 1] && azimuths_[i] <= azimuths_[0] + kTurn));
  });
  throwIf(values_.size() != polar_.size() * azimuths_.size(), "there are ", values_.size(),
    " values for ", azimuths_.size(), " azimuths and ", polar_.size(), " polar angles");
  constexpr double kMost = 1e30;
  checkEach(
    values_, "value", [&](std::size_t i) { return values_[i] >= 0 && values_[i] <= kMost; });
  for (std::vector<double>* const angles : { &polar_, &azimuths_ })
  {
    std::transform(angles->begin(), angles->end(), angles->begin(),
      [](double degrees) { return degrees * kDegree; });
  }
  for (std::size_t plane = 0; plane < azimuths_.size(); ++plane)
  {
    below_.push_back(0);
    for (std::size_t i = 1; i < polar_.size(); ++i)
    {
      const double width = polar_[i] - polar_[i - 1], from = at(plane, i - 1);
      below_.push_back(below_.back() +
        (width > 0 ? overStep(polar_[i - 1], width, from, (at(plane, i) - from) / width) : 0));
    }
  }
  const std::size_t last = polar_.size() - 1;
  cumulative_.push_back(isRound() ? 2 * kPi * belowAngle(0, last) : 0);
  for (std::size_t plane = 1; plane < azimuths_.size(); ++plane)
  {
    cumulative_.push_back(cumulative_.back() +
      (azimuths_[plane] - azimuths_[plane - 1]) *
        (belowAngle(plane - 1, last) + belowAngle(plane, last)) / 2);
  }
}

Vector3 DirectionTable::direction(double polar, double azimuth) const
{
  const double turns = azimuth / (2 * kPi);
  const SinCos height(polar / (2 * kPi)), around(std::clamp(turns - std::floor(turns), 0.0, 1.0));
  return { height.sine * around.cosine, height.sine * around.sine, height.cosine };
}

double DirectionTable::value(const Vector3& direction) const
{
  const double polar =
    arcTangent(std::sqrt(direction[0] * direction[0] + direction[1] * direction[1]), direction[2]);
  const double azimuth = isRound() ? 0 : arcTangent(std::abs(direction[1]), direction[0]);
  return valueAt(polar, std::copysign(azimuth, direction[1]), 1);
}

double DirectionTable::valueAt(double polar, double azimuth, int side) const
{
  if (polar < polar_.front() || polar > polar_.back())
  {
    return 0;
  }
  std::size_t angle = stepOf(polar_, polar);
  while (side < 0 && angle > 0 && polar <= polar_[angle])
  {
    --angle;
  }
  const double width = polar_[angle + 1] - polar_[angle];
  const double part = width > 0 ? (polar - polar_[angle]) / width : 0;
  const auto ofPlane = [&](std::size_t plane) {
    return between(at(plane, angle), at(plane, angle + 1), part);
  };
  if (isRound())
  {
    return ofPlane(0);
  }
  const double turns = (azimuth - azimuths_.front()) / (2 * kPi);
  const double around = azimuths_.front() + 2 * kPi * (turns - std::floor(turns));
  if (around > azimuths_.back() * (1 + 0x1p-50))
  {
    return 0;
  }
  const std::size_t plane = stepOf(azimuths_, around);
  return between(ofPlane(plane), ofPlane(plane + 1),
    (around - azimuths_[plane]) / (azimuths_[plane + 1] - azimuths_[plane]));
}

Vector3 DirectionTable::sample(const std::array<double, 2>& u) const
{
  const std::size_t last = polar_.size() - 1;
  std::size_t plane = 0, next = 0;
  double azimuth = 2 * kPi * u[0], beside = 0; // the part of the second plane
  if (!isRound())
  {
    const WeightChoice step = chooseByWeight(cumulative_, u[0]); // the first has no width
    plane = step.place - 1;
    next = step.place;
    beside = sampleLinear(step.rest, belowAngle(plane, last), belowAngle(next, last));
    azimuth = between(azimuths_[plane], azimuths_[next], beside);
  }
  const auto below = [&](std::size_t angle) {
    return between(belowAngle(plane, angle), belowAngle(next, angle), beside);
  };
  const double target = u[1] * below(last);
  std::size_t first = 0;
  for (std::size_t count = last; count > 1;)
  {
    const std::size_t half = count / 2;
    first += below(first + half) <= target ? half : 0;
    count -= half;
  }
  const double width = polar_[first + 1] - polar_[first];
  const double part = restOf(target - below(first), below(first + 1) - below(first));
  const double from = between(at(plane, first), at(next, first), beside),
               to = between(at(plane, first + 1), at(next, first + 1), beside);
  return direction(
    polar_[first] + placeInStep(polar_[first], width, from, (to - from) / width, part), azimuth);
}

}
