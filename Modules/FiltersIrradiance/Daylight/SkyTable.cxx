// SPDX-License-Identifier: BSD-3-Clause
#include "Daylight/SkyTable.h"

#include "Progress/InputError.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace irradiance
{

namespace
{

/// a, b, c, d, e of the types 1 to 15.
constexpr double kCie[15][5] = { { 4, -.70, 0, -1, 0 }, { 4, -.70, 2, -1.5, .15 },
  { 1.1, -.80, 0, -1, 0 }, { 1.1, -.80, 2, -1.5, .15 }, { 0, -1, 0, -1, 0 },
  { 0, -1, 2, -1.5, .15 }, { 0, -1, 5, -2.5, .30 }, { 0, -1, 10, -3, .45 },
  { -1, -.55, 2, -1.5, .15 }, { -1, -.55, 5, -2.5, .30 }, { -1, -.55, 10, -3, .45 },
  { -1, -.32, 10, -3, .45 }, { -1, -.32, 16, -3, .30 }, { -1, -.15, 16, -3, .30 },
  { -1, -.15, 24, -2.8, .15 } };

/// Where the bins of Perez' clearness end.
constexpr double kClearness[7] = { 1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200 };

/// For each bin four coefficients each of a, b, c, d, e.
constexpr double kPerez[8][20] = {
  { 1.3525, -.2576, -.2690, -1.4366, -.7670, .0007, 1.2734, -.1233, 2.8000, .6004, 1.2375, 1.0000,
    1.8734, .6297, .9738, .2809, .0356, -.1246, -.5718, .9938 },
  { -1.2219, -.7730, 1.4148, 1.1016, -.2054, .0367, -3.9128, .9156, 6.9750, .1774, 6.4477, -.1239,
    -1.5798, -.5081, -1.7812, .1080, .2624, .0672, -.2190, -.4285 },
  { -1.1000, -.2515, .8952, .0156, .2782, -.1812, -4.5000, 1.1766, 24.7219, -13.0812, -37.7000,
    34.8438, -5.0000, 1.5218, 3.9229, -2.6204, -.0156, .1597, .4199, -.5562 },
  { -.5484, -.6654, -.2672, .7117, .7234, -.6219, -5.6812, 2.6297, 33.3389, -18.3000, -62.2500,
    52.0781, -3.5000, .0016, 1.1477, .1062, .4659, -.3296, -.0876, -.0329 },
  { -.6000, -.3566, -2.5000, 2.3250, .2937, .0496, -5.6812, 1.8415, 21.0000, -4.7656, -21.5906,
    7.2492, -3.5000, -.1554, 1.4062, .3988, .0032, .0766, -.0656, -.1294 },
  { -1.0156, -.3670, 1.0078, 1.4051, .2875, -.5328, -3.8500, 3.3750, 14.0000, -.9999, -7.1406,
    7.5469, -3.4000, -.1078, -1.0750, 1.5702, -.0672, .4016, .3017, -.4844 },
  { -1.0000, .0211, .5025, -.5119, -.3000, .1922, .7023, -1.6317, 19.0000, -5.0000, 1.2438, -1.9094,
    -4.0000, .0250, .3844, .2656, 1.0468, -.3788, -2.4517, 1.4656 },
  { -1.0500, .0289, .4260, .3590, -.3250, .1156, .7781, .0025, 31.0625, -14.5000, -46.1148, 55.3750,
    -7.2312, .4050, 13.3500, .6234, 1.5000, -.6426, 1.8564, .5636 }
};

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
std::pair<double, double> stepWeights(double firstDegrees, double secondDegrees)
{
  const double a = vtkMath::RadiansFromDegrees(firstDegrees);
  const double b = vtkMath::RadiansFromDegrees(secondDegrees);
  const auto integral = [](double t) { return -std::cos(2 * t) / 4; };
  const auto moment = [](double t) { return (std::sin(2 * t) / 2 - t * std::cos(2 * t)) / 4; };
  const double all = integral(b) - integral(a);
  const double second = (moment(b) - moment(a) - a * all) / (b - a);
  return { all - second, second };
}

/// The exact integral of radiance times the cosine, of a table without ground.
double horizontalIrradiance(const SkyTable& sky)
{
  const std::vector<double>& azimuths = sky.azimuths;
  const std::size_t rows = sky.polarAngles.size();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < rows; ++i)
  {
    const auto [first, second] = stepWeights(sky.polarAngles[i], sky.polarAngles[i + 1]);
    const auto along = [&, first = first, second = second](std::size_t azimuth) {
      const double* column = sky.radiance.data() + azimuth * rows;
      return first * column[i] + second * column[i + 1];
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

/// At the horizon it is the limit for b < 0.
double radianceOf(const SkyShape& sky, double cosZenith, double sunAngle)
{
  const double gradation =
    sky.isOvercast ? 1 + 2 * cosZenith : 1 + sky.a * std::exp(sky.b / std::max(cosZenith, 1e-9));
  const double cosSun = std::cos(sunAngle);
  return gradation * (sky.f + sky.c * std::exp(sky.d * sunAngle) + sky.e * cosSun * cosSun);
}

}

SkyShape cieSky(int type)
{
  const double(&row)[5] = kCie[type - 1];
  SkyShape sky{ row[0], row[1], row[2], row[3], row[4] };
  sky.f = 1 - sky.c * std::exp(sky.d * vtkMath::Pi() / 2);
  return sky;
}

SkyShape perezSky(
  double directNormal, double diffuseHorizontal, double sunAltitude, double distanceFactor)
{
  const double degrees = 90 - sunAltitude, zenith = vtkMath::RadiansFromDegrees(degrees);
  const double cube = 1.041 * zenith * zenith * zenith;
  const double clearness =
    ((diffuseHorizontal + directNormal) / diffuseHorizontal + cube) / (1 + cube);
  // The relative air mass after Kasten (1966).
  const double airMass = 1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - degrees, -1.253));
  double brightness = std::clamp(diffuseHorizontal * airMass / (1367 * distanceFactor), 0.01, 0.6);
  if (clearness > kClearness[0] && clearness < kClearness[4])
  {
    brightness = std::max(brightness, 0.2);
  }
  const auto bin = std::upper_bound(std::begin(kClearness), std::end(kClearness), clearness) -
    std::begin(kClearness);
  const double* row = kPerez[bin];
  const auto linear = [&](const double* x) {
    return x[0] + x[1] * zenith + brightness * (x[2] + x[3] * zenith);
  };
  SkyShape sky{ linear(row), linear(row + 4), linear(row + 8), linear(row + 12), linear(row + 16) };
  if (bin == 0)
  {
    const double *c = row + 8, *d = row + 12;
    sky.c = std::exp(std::pow(brightness * (c[0] + c[1] * zenith), c[2])) - c[3];
    sky.d = -std::exp(brightness * (d[0] + d[1] * zenith)) + d[2] + brightness * d[3];
  }
  return sky;
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
  table.azimuths =
    shape.c == 0 && shape.e == 0 ? std::vector<double>{ 0 } : denseAround({ sun.azimuth }, 360);
  const auto toSun = sun.direction();
  double least = 0;
  for (const double azimuth : table.azimuths)
  {
    for (const double polar : table.polarAngles)
    {
      const auto to = SunPosition{ azimuth, 90 - polar }.direction();
      const double cosine = vtkMath::Dot(to.data(), toSun.data());
      const double radiance = radianceOf(shape, to[2], std::acos(std::clamp(cosine, -1., 1.)));
      least = std::min(least, radiance);
      table.radiance.push_back(std::max(radiance, 0.));
    }
  }
  if (least < 0)
  {
    table.note += (table.note.empty() ? "" : "; ") +
      std::string("the radiance would be negative in places (it counts as 0 there)");
  }
  double sum = horizontalIrradiance(table);
  if (!(sum > 0))
  {
    table.note += "; the sky counts as uniform";
    std::fill(table.radiance.begin(), table.radiance.end(), 1.);
    sum = horizontalIrradiance(table);
  }
  for (double& value : table.radiance)
  {
    value *= diffuseHorizontal / sum;
  }
  return table;
}

}
