// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/DirectionTable.h"

#include "Progress/InputError.h"
#include "Sampling/WeightChoice.h"

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

/// A turn by 0 to 360 degrees: what the sine lacks of the angle, and the cosine of 1, by Taylor's
/// series where these would cancel.
struct Turn
{
  double angle, lag, sine, versine;

  __attribute__((always_inline)) explicit Turn(double radians)
    : angle(radians)
  {
    const double z = angle * angle, zz = z * z;
    lag = angle * z * ((1 / 6.0 - z * (1 / 120.0)) + zz * (1 / 5040.0 - z * (1 / 362880.0)));
    versine = z * ((1 / 2.0 - z * (1 / 24.0)) + zz * (1 / 720.0 - z * (1 / 40320.0)));
    if (angle > 0.18) // up to here what is left out of the series is below 2^-46
    {
      const SinCos whole(std::min(angle / (2 * kPi), 1.0));
      lag = angle - whole.sine;
      versine = 1 - whole.cosine;
    }
    sine = angle - lag;
  }
  /// By the addition theorem. Twice a difference: of one beside a sum GCC 12 makes fused products,
  /// where there are any, in spite of -ffp-contract=off.
  __attribute__((always_inline)) SinCos from(const SinCos& start) const
  {
    SinCos sum = start;
    sum.sine += start.cosine * sine - start.sine * versine;
    sum.cosine += -start.sine * sine - start.cosine * versine;
    return sum;
  }
};

/// The integral over a turn from an angle on of what is linear in it, times the sine: of `from`, and
/// what it grows by each radian. By parts, as the sine's integral is known.
inline double overTurn(const SinCos& start, const Turn& turn, double from, double growth)
{
  return (from + growth * turn.angle) * (start.sine * turn.sine + start.cosine * turn.versine) -
    growth * (start.sine * turn.versine + start.cosine * turn.lag);
}

/// Where in a step the integral is `wanted`, a part of the whole. By the series of the inverse up to
/// the third power, within bounds, from where it would be if the sine were linear as well.
inline double placeInStep(
  const SinCos* ends, double width, double from, double to, double wanted, double part)
{
  const double growth = (to - from) / width;
  double lower = 0, upper = width,
         place = width * sampleLinear(part, from * ends[0].sine, std::max(0.0, to * ends[1].sine));
  constexpr int kMostSteps = 64;
  for (int i = 0; i < kMostSteps; ++i)
  {
    const Turn turn(place);
    const SinCos here = turn.from(ends[0]);
    const double value = from + growth * place,
                 excess = overTurn(ends[0], turn, from, growth) - wanted;
    (excess > 0 ? upper : lower) = place;
    const double inverse = 1 / (value * here.sine), newton = excess * inverse;
    const double slope = (growth * here.sine + value * here.cosine) * inverse, half = slope / 2,
                 bend = (2 * growth * here.cosine - value * here.sine) * inverse;
    const double next =
      place - newton * (1 + newton * (half + newton * (half * slope - bend * (1 / 6.0))));
    place = next >= lower && next <= upper ? next : (lower + upper) / 2;
    if (std::abs(newton) * (1 + std::abs(slope) * width) <= 0x1p-8 * width)
    {
      break; // less than 2^-32 of the width is left out
    }
  }
  return place;
}

/// Adds on which step an increasing function reaches each of as many even parts of its last value
/// as it has steps.
void addGuide(const double* function, std::size_t steps, std::vector<std::uint32_t>& guide)
{
  for (std::size_t i = 0, step = 0; i <= steps; ++i)
  {
    const double border = static_cast<double>(i) / static_cast<double>(steps) * function[steps];
    while (step + 1 < steps && function[step + 1] < border)
    {
      ++step;
    }
    guide.push_back(static_cast<std::uint32_t>(step));
  }
}

/// The last step from `first` to `last` at whose start an increasing function is at most a target.
template <class Function>
std::size_t stepBelow(const Function& function, double target, std::size_t first, std::size_t last)
{
  std::size_t count = last + 1 - first;
  do // once also if there is only one, as nobody can predict whether there are two
  {
    const std::size_t half = count / 2;
    first += function(first + half) <= target ? half : 0;
    count -= half;
  } while (count > 1);
  return first;
}

/// The step of increasing angles on which an angle falls, the later one at a border. A guess, which
/// is right of even steps, and from there step by step.
std::size_t stepOf(const std::vector<double>& angles, double angle)
{
  const std::size_t last = angles.size() - 2;
  const double whole = angles.back() - angles.front();
  const double guess =
    whole > 0 ? (angle - angles.front()) / whole * static_cast<double>(last + 1) : 0;
  std::size_t step = std::min<std::size_t>(static_cast<std::uint32_t>(guess), last);
  while (angle < angles[step] && step > 0)
  {
    --step;
  }
  while (angle >= angles[step + 1] && step < last)
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
    for (const double angle : *angles)
    {
      const double turns = angle / (2 * kPi);
      (angles == &polar_ ? ofPolar_ : ofAzimuth_)
        .emplace_back(std::clamp(turns - std::floor(turns), 0.0, 1.0));
    }
  }
  below_.reserve(values_.size());
  angleGuide_.reserve(values_.size());
  const std::size_t last = polar_.size() - 1;
  for (std::size_t plane = 0; plane < azimuths_.size(); ++plane)
  {
    below_.push_back(0);
    for (std::size_t i = 1; i < polar_.size(); ++i)
    {
      const double width = polar_[i] - polar_[i - 1], from = at(plane, i - 1);
      below_.push_back(below_.back() +
        overTurn(
          ofPolar_[i - 1], Turn(width), from, width > 0 ? (at(plane, i) - from) / width : 0));
    }
    addGuide(&below_[plane * polar_.size()], last, angleGuide_);
  }
  cumulative_.push_back(isRound() ? 2 * kPi * belowAngle(0, last) : 0);
  for (std::size_t plane = 1; plane < azimuths_.size(); ++plane)
  {
    cumulative_.push_back(cumulative_.back() +
      (azimuths_[plane] - azimuths_[plane - 1]) *
        (belowAngle(plane - 1, last) + belowAngle(plane, last)) / 2);
  }
  addGuide(cumulative_.data(), azimuths_.size() - 1, planeGuide_);
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
  const auto last = static_cast<std::uint32_t>(polar_.size() - 1);
  std::size_t plane = 0, next = 0;
  double turn = 2 * kPi * u[0], beside = 0; // the part of the second plane
  if (!isRound())
  {
    const double target = u[0] * cumulative_.back();
    const auto steps = static_cast<std::uint32_t>(azimuths_.size() - 1);
    const std::uint32_t* const guide = &planeGuide_[static_cast<std::uint32_t>(u[0] * steps)];
    plane = stepBelow([&](std::size_t i) { return cumulative_[i]; }, target, guide[0], guide[1]);
    next = plane + 1;
    beside =
      sampleLinear(restOf(target - cumulative_[plane], cumulative_[next] - cumulative_[plane]),
        belowAngle(plane, last), belowAngle(next, last));
    turn = beside * (azimuths_[next] - azimuths_[plane]);
  }
  const auto value = [&](std::size_t i) { return between(at(plane, i), at(next, i), beside); };
  const auto below = [&](std::size_t i) {
    return between(belowAngle(plane, i), belowAngle(next, i), beside);
  };
  const double target = u[1] * below(last);
  // What lies between two planes reaches a part of its integral between where these reach it.
  const auto part = static_cast<std::uint32_t>(u[1] * last);
  const std::uint32_t *const guide = &angleGuide_[plane * polar_.size() + part],
                             *const nextGuide = &angleGuide_[next * polar_.size() + part];
  const std::size_t angle =
    stepBelow(below, target, std::min(guide[0], nextGuide[0]), std::max(guide[1], nextGuide[1]));
  const double wanted = target - below(angle);
  const double place = placeInStep(&ofPolar_[angle], polar_[angle + 1] - polar_[angle],
    value(angle), value(angle + 1), wanted, restOf(wanted, below(angle + 1) - below(angle)));
  const SinCos height = Turn(place).from(ofPolar_[angle]),
               around = Turn(turn).from(ofAzimuth_[plane]);
  return { height.sine * around.cosine, height.sine * around.sine, height.cosine };
}

}
