// SPDX-License-Identifier: BSD-3-Clause
#include "Daylight/SkyTable.h"

#include "Progress/InputError.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiance
{

namespace
{

/// Angles from 0 to `last`, denser around the centres; those past an end come in at the other.
std::vector<double> denseAround(const std::vector<double>& centres, double last)
{
  constexpr double kStep = 2.5, kEqual = 1e-6;
  std::vector<double> angles;
  for (int i = 1; i * kStep < last; ++i)
  {
    angles.push_back(i * kStep);
  }
  for (const double centre : centres)
  {
    for (const double offset : { 0., 0.25, 0.5, 1., 1.75, 3., 4., 6. })
    {
      for (const double angle : { centre - offset, centre + offset })
      {
        angles.push_back(angle - last * std::floor(angle / last));
      }
    }
  }
  const auto isEnd = [last](double angle) { return angle < kEqual || angle > last - kEqual; };
  angles.erase(std::remove_if(angles.begin(), angles.end(), isEnd), angles.end());
  angles.insert(angles.end(), { 0, last });
  std::sort(angles.begin(), angles.end());
  const auto isSame = [](double a, double b) { return b - a < kEqual; };
  angles.erase(std::unique(angles.begin(), angles.end(), isSame), angles.end());
  return angles;
}

/// What the values at both ends of a step contribute to the integral of a linear function of the
/// angle t times sin t cos t.
struct StepWeights
{
  double first, second;
};

StepWeights stepWeights(double firstDegrees, double secondDegrees)
{
  const double a = vtkMath::RadiansFromDegrees(firstDegrees);
  const double b = vtkMath::RadiansFromDegrees(secondDegrees);
  const auto integral = [](double t) { return -std::cos(2 * t) / 4; };
  const auto moment = [](double t) { return (std::sin(2 * t) / 2 - t * std::cos(2 * t)) / 4; };
  const double all = integral(b) - integral(a);
  const double second = (moment(b) - moment(a) - a * all) / (b - a);
  return { all - second, second };
}

}

double SkyTable::horizontalIrradiance() const
{
  const std::size_t rows = polarAngles.size();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < rows && polarAngles[i + 1] <= 90; ++i)
  {
    if (polarAngles[i] == polarAngles[i + 1])
    {
      continue;
    }
    const StepWeights weights = stepWeights(polarAngles[i], polarAngles[i + 1]);
    const auto along = [&](std::size_t azimuth) {
      const double* column = radiance.data() + azimuth * rows;
      return weights.first * column[i] + weights.second * column[i + 1];
    };
    sum += azimuths.size() == 1 ? 2 * vtkMath::Pi() * along(0) : 0;
    for (std::size_t k = 0; k + 1 < azimuths.size(); ++k)
    {
      sum +=
        vtkMath::RadiansFromDegrees(azimuths[k + 1] - azimuths[k]) * (along(k) + along(k + 1)) / 2;
    }
  }
  return sum;
}

void SkyTable::addGround(double groundRadiance)
{
  std::vector<double> all;
  const auto rows = static_cast<std::ptrdiff_t>(polarAngles.size());
  for (auto column = radiance.begin(); column != radiance.end(); column += rows)
  {
    all.insert(all.end(), column, column + rows);
    all.insert(all.end(), 2, groundRadiance);
  }
  radiance = std::move(all);
  polarAngles.insert(polarAngles.end(), { 90, 180 });
}

SkyTable skyTable(SkyShape shape, const SunPosition& sun, double diffuseHorizontal)
{
  SkyTable table;
  if (shape.b > 0)
  {
    table.note = "the radiance would grow without limit towards the horizon (b is " +
      text(shape.b) + ", and counts as 0)";
    shape.b = 0;
  }
  table.polarAngles = denseAround({ 90 - sun.altitude, 90 }, 90);
  table.azimuths = shape.isRound() ? std::vector<double>{ 0 } : denseAround({ sun.azimuth }, 360);
  const auto toSun = sun.direction();
  double least = 0;
  for (const double azimuth : table.azimuths)
  {
    for (const double polar : table.polarAngles)
    {
      const auto to = SunPosition{ azimuth, 90 - polar }.direction();
      const double cosine = vtkMath::Dot(to.data(), toSun.data());
      const double radiance = shape.radiance(to[2], std::acos(std::clamp(cosine, -1., 1.)));
      least = std::min(least, radiance);
      table.radiance.push_back(std::max(radiance, 0.));
    }
  }
  if (least < 0)
  {
    table.note += (table.note.empty() ? "" : "; ") +
      std::string("the radiance would be negative in places (it counts as 0 there)");
  }
  double sum = table.horizontalIrradiance();
  if (!(sum > 0))
  {
    table.note += "; the sky counts as uniform";
    std::fill(table.radiance.begin(), table.radiance.end(), 1.);
    sum = table.horizontalIrradiance();
  }
  for (double& value : table.radiance)
  {
    value *= diffuseHorizontal / sum;
  }
  return table;
}

}
