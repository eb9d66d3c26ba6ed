// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/DirectionTable.h"

#include "../MessageOf.h"
#include "DirectionBins.h"
#include "Sampling/SobolPoint.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

namespace irradiance::test
{
namespace
{

constexpr double kDegrees = M_PI / 180;

Vector3 towards(double polar, double azimuth)
{
  return { std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
    std::cos(polar) };
}

/// What is linear in both angles, by its definition.
struct Grid
{
  const char* name;
  std::vector<double> polar, azimuths, values;

  DirectionTable table() const { return { polar, azimuths, values }; }
  std::size_t steps() const { return azimuths.size() == 1 ? 1 : azimuths.size() - 1; }
  /// From and to, radians, of a step of azimuth.
  std::array<double, 2> turn(std::size_t step) const
  {
    return azimuths.size() == 1
      ? std::array<double, 2>{ 0, 2 * M_PI }
      : std::array<double, 2>{ kDegrees * azimuths[step], kDegrees * azimuths[step + 1] };
  }
  /// In a patch, as parts of its sides.
  double at(std::size_t step, std::size_t angle, double along, double up) const
  {
    const auto ofPlane = [&](std::size_t plane) {
      const double* const first = &values[plane * polar.size() + angle];
      return (1 - up) * first[0] + up * first[1];
    };
    return azimuths.size() == 1 ? ofPlane(0)
                                : (1 - along) * ofPlane(step) + along * ofPlane(step + 1);
  }

  static constexpr double kPlaces[] = { -0.906179845938664, -0.538469310105683, 0,
    0.538469310105683, 0.906179845938664 };
  static constexpr double kWeights[] = { 0.236926885056189, 0.478628670499366, 0.568888888888889,
    0.478628670499366, 0.236926885056189 };

  /// By 5 points of Gauss in 8 parts of each patch each way.
  using Weight = std::function<double(const Vector3&)>;
  double integral(const Weight& weight) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < steps() * (polar.size() - 1) * 1600; ++i)
    {
      const std::size_t patch = i / 1600, step = patch % steps(), angle = patch / steps();
      const auto placeOf = [&](std::size_t k) {
        return (static_cast<double>(k / 5) + (1 + kPlaces[k % 5]) / 2) / 8;
      };
      const double along = placeOf(i % 40), up = placeOf(i / 40 % 40);
      const auto [from, to] = turn(step);
      const double low = kDegrees * polar[angle], rise = kDegrees * polar[angle + 1] - low;
      sum += kWeights[i % 5] * kWeights[i / 40 % 5] / 256 * at(step, angle, along, up) *
        std::sin(low + up * rise) * rise * (to - from) *
        weight(towards(low + up * rise, from + along * (to - from)));
    }
    return sum;
  }
  /// Along a step of azimuth, up to a polar angle: of each radian of azimuth. By 5 points of Gauss
  /// in 8 parts.
  double upTo(double end, std::size_t step, double along) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < (polar.size() - 1) * 40; ++i)
    {
      const std::size_t angle = i / 40;
      const double low = kDegrees * polar[angle], rise = kDegrees * polar[angle + 1] - low;
      const double width = std::min(rise, end - low);
      const double up = (static_cast<double>(i / 5 % 8) + (1 + kPlaces[i % 5]) / 2) / 8 * width;
      sum += width <= 0
        ? 0
        : kWeights[i % 5] / 16 * width * at(step, angle, along, up / rise) * std::sin(low + up);
    }
    return sum;
  }
};

double alike(const Vector3&)
{
  return 1;
}

std::vector<double> randomValues(std::size_t count, unsigned seed)
{
  std::mt19937 engine(seed);
  std::vector<double> values(count);
  std::generate(values.begin(), values.end(), [&] { return 0.1 + engine() % 1000 / 100.; });
  return values;
}

/// Round, jumps, parts of the circle, over 0 and 360 degrees, narrow, dark in parts.
std::vector<Grid> grids()
{
  return { { "round", { 0, 45, 90 }, { 0 }, { 1, 0.7, 0 } },
    { "one plane elsewhere", { 20, 70, 180 }, { 77 }, { 3, 1, 2 } },
    { "jumps", { 0, 30, 30, 90, 90, 120, 120 }, { 0 }, { 1, 2, 5, 4, 0, 1, 0 } },
    { "to the axis", { 100, 140, 180 }, { 0, 90, 360 }, randomValues(9, 1) },
    { "part", { 10, 50, 100 }, { 20, 60, 100 }, randomValues(9, 2) },
    { "all around", { 0, 20, 60, 130, 180 }, { 0, 90, 180, 270, 360 }, randomValues(25, 3) },
    { "negative", { 0, 60, 90 }, { -75, -30, 0, 45 }, randomValues(12, 4) },
    { "over 360", { 0, 60, 90 }, { 345, 360, 390 }, randomValues(9, 5) },
    { "from 300 on", { 0, 60, 60, 90 }, { 300, 390, 500, 660 }, randomValues(16, 6) },
    { "beam", { 0, 4, 8, 180 }, { 0, 180, 360 },
      { 1e3, 800, 0.1, 0.1, 1e3, 200, 0, 0.2, 1e3, 800, 0.1, 0.1 } },
    { "dark", { 0, 20, 40, 60, 80 }, { 0, 40, 80, 120, 160 },
      { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 } } };
}

TEST(DirectionTable, IsLinearInBothAngles)
{
  for (const Grid& grid : grids())
  {
    const DirectionTable table = grid.table();
    const double most = *std::max_element(grid.values.begin(), grid.values.end());
    for (std::size_t i = 0; i < grid.steps() * (grid.polar.size() - 1) * 64; ++i)
    {
      const std::size_t step = i / 64 % grid.steps(), angle = i / 64 / grid.steps();
      const double along = (i % 8 + 0.5) / 8, up = (i / 8 % 8 + 0.5) / 8;
      const auto [from, to] = grid.turn(step);
      const double polar = grid.polar[angle] + up * (grid.polar[angle + 1] - grid.polar[angle]);
      if (grid.polar[angle] < grid.polar[angle + 1])
      {
        EXPECT_NEAR(table.value(towards(kDegrees * polar, from + along * (to - from))),
          grid.at(step, angle, along, up), 1e-12 * most)
          << grid.name << ", patch " << step << " " << angle;
      }
    }
  }
}

TEST(DirectionTable, IsZeroElsewhere)
{
  const DirectionTable part({ 10, 90 }, { 345, 360, 390 }, { 1, 1, 1, 1, 1, 1 });
  const auto at = [&](double polar, double azimuth) {
    return part.value(towards(kDegrees * polar, kDegrees * azimuth));
  };
  for (const double azimuth : { 31.0, 90.0, 180.0, 270.0, 344.0, -16.0 })
  {
    EXPECT_EQ(at(50, azimuth), 0) << azimuth;
  }
  for (const double azimuth : { 345.1, -14.9, 0.0, 360.0, 29.9 })
  {
    EXPECT_EQ(at(50, azimuth), 1) << azimuth;
    EXPECT_EQ(at(9.9, azimuth) + at(90.1, azimuth) + at(180, azimuth), 0);
  }
  EXPECT_EQ(DirectionTable({ 10, 20 }, { 0 }, { 1, 1 }).value({ 0, 0, 1 }), 0) << "on the axis";
}

TEST(DirectionTable, IntegralIsThatOfAFineQuadrature)
{
  EXPECT_NEAR(DirectionTable({ 0, 180 }, { 0 }, { 2, 2 }).integral(), 8 * M_PI, 1e-13);
  EXPECT_NEAR(DirectionTable({ 60, 90 }, { 0, 90 }, { 2, 2, 2, 2 }).integral(), M_PI / 2, 1e-13);
  for (const Grid& grid : grids())
  {
    const double expected = grid.integral(alike);
    EXPECT_NEAR(grid.table().integral(), expected, 1e-12 * expected) << grid.name;
    double sum = 0;
    grid.table().forEachPart([&](const Vector3&, double weight) { sum += weight; });
    EXPECT_NEAR(sum, expected, 1e-2 * expected) << grid.name << ", by its parts";
  }
}

TEST(DirectionTable, SamplesHaveItsDensity)
{
  for (const Grid& grid : grids())
  {
    SCOPED_TRACE(grid.name);
    const DirectionTable table = grid.table();
    expectDensity([&](const Vector3& direction) { return table.value(direction); },
      [&](const std::array<double, 2>& u) { return table.sample(u); });
  }
}

// By Sobol' points, whose error is far below that of chance.
TEST(DirectionTable, SampledMeansAreThoseOfQuadrature)
{
  const std::vector<Grid::Weight> weights{ [](const Vector3& d) { return d.x(); },
    [](const Vector3& d) { return d.y(); }, [](const Vector3& d) { return d.z(); },
    [](const Vector3& d) { return d.x() * d.y() + d.z() * d.z(); },
    [](const Vector3& d) { return std::exp(d.x() - 2 * d.y()); } };
  const std::uint32_t count = scaled(1u << 15);
  for (const Grid& grid : grids())
  {
    const DirectionTable table = grid.table();
    std::vector<double> sums(weights.size());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Vector3 direction = table.sample(SobolPoint::inUnitSquare(i, SampleKeys(7)));
      EXPECT_NEAR(direction.norm(), 1, 1e-12);
      for (std::size_t k = 0; k < weights.size(); ++k)
      {
        sums[k] += weights[k](direction) / count;
      }
    }
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      EXPECT_NEAR(sums[k], grid.integral(weights[k]) / table.integral(), kIsSanitized ? 0.01 : 1e-3)
        << grid.name << ", weight " << k;
    }
  }
}

// So evenly spread samples give evenly spread light: the parts of the light below a sample's
// azimuth, and there below its polar angle, are the sample, by quadrature.
TEST(DirectionTable, SamplesAreByInversion)
{
  std::vector<Grid> all = grids();
  all.push_back({ "wide", { 0, 90, 180 }, { 0, 180, 360 }, randomValues(9, 7) });
  all.push_back({ "half dark", { 0, 90, 180 }, { 0, 180 }, { 0, 1, 0, 2, 0, 3 } });
  all.push_back({ "half of the circle", { 0, 180 }, { 0 }, { 0, 1 } });
  all.push_back({ "narrow", { 30, 30.0001, 30.0002 }, { 0, 0.0001 }, randomValues(6, 8) });
  all.push_back({ "degrees", {}, { 0, 5, 355 }, randomValues(3 * 181, 9) });
  for (int degree = 0; degree <= 180; ++degree)
  {
    all.back().polar.push_back(degree);
  }
  constexpr double kPolar = M_PI;
  RandomVectors random(3);
  for (const Grid& grid : all)
  {
    const DirectionTable table = grid.table();
    for (int i = 0; i < 400; ++i)
    {
      std::array<double, 2> u{ random.uniform(0, 1), random.uniform(0, 1) };
      u[i % 2] = i < 100 ? std::ldexp(1, -i % 34 - 1)
        : i < 200        ? 1 - std::ldexp(1, -i % 34 - 1)
                         : u[i % 2];
      const Vector3 d = table.sample(u);
      const double turns = (std::atan2(d.y(), d.x()) - kDegrees * grid.azimuths[0]) / (2 * M_PI);
      const double azimuth = 2 * M_PI * (turns - std::floor(turns));
      double whole = 0, before = 0, along = 0;
      std::size_t found = 0;
      for (std::size_t step = 0; step < grid.steps(); ++step)
      {
        const auto [from, to] = grid.turn(step);
        const double at = azimuth - (from - grid.turn(0)[0]),
                     part = std::clamp(at / (to - from), 0.0, 1.0);
        found = at >= 0 ? step : found;
        along = at >= 0 ? part : along;
        const double first = grid.upTo(kPolar, step, 0), last = grid.upTo(kPolar, step, 1);
        before += part * (to - from) * (first + part / 2 * (last - first));
        whole += (to - from) * (first + last) / 2;
      }
      EXPECT_NEAR(before / whole, u[0], 1e-9) << grid.name << ": " << u[0] << " " << u[1];
      EXPECT_NEAR(grid.upTo(std::atan2(std::hypot(d.x(), d.y()), d.z()), found, along) /
          grid.upTo(kPolar, found, along),
        u[1], 1e-9)
        << grid.name << ": " << u[0] << " " << u[1];
    }
  }
}

TEST(DirectionTable, SaysWhatIsWrong)
{
  const double nan = std::nan("");
  const std::vector<double> two{ 0, 90 }, ones{ 1, 1 };
  const struct
  {
    std::vector<double> polar, azimuths, values;
    const char* message;
  } wrong[] = {
    { {}, { 0 }, {}, "there are 0 polar angles; 2 or more" },
    { { 0 }, { 0 }, { 1 }, "there are 1 polar angles; 2 or more" },
    { two, {}, {}, "there are no azimuths" },
    { { -1, 90 }, { 0 }, ones, "polar angle number 0 is -1" },
    { { 0, 50, 40 }, { 0 }, { 1, 1, 1 }, "polar angle number 2 is 40" },
    { { 0, 181 }, { 0 }, ones, "polar angle number 1 is 181" },
    { { 0, nan }, { 0 }, ones, "polar angle number 1 is nan" },
    { two, { 0, 0 }, { 1, 1, 1, 1 }, "azimuth number 1 is 0" },
    { two, { 0, 180, 361 }, { 1, 1, 1, 1, 1, 1 }, "azimuth number 2 is 361" },
    { two, { -10, 351 }, { 1, 1, 1, 1 }, "azimuth number 1 is 351" },
    { two, { 721 }, ones, "azimuth number 0 is 721" },
    { two, { nan }, ones, "azimuth number 0 is nan" },
    { two, { 0, 90 }, ones, "there are 2 values for 2 azimuths and 2 polar angles" },
    { two, { 0 }, { 1, -2 }, "value number 1 is -2" },
    { two, { 0 }, { nan, 1 }, "value number 0 is nan" },
    { two, { 0 }, { 1, kInfinity }, "value number 1 is inf" },
  };
  for (const auto& row : wrong)
  {
    const std::string message =
      MessageOf([&] { DirectionTable(row.polar, row.azimuths, row.values); });
    EXPECT_NE(message.find(row.message), std::string::npos) << row.message << " : " << message;
  }
  EXPECT_EQ(DirectionTable(two, { 0 }, { 0, 0 }).integral(), 0) << "dark, but right";
  EXPECT_TRUE(DirectionTable(two, { 0 }, ones) == DirectionTable(two, { 0 }, ones));
  EXPECT_FALSE(DirectionTable(two, { 0 }, ones) == DirectionTable(two, { 0 }, { 1, 2 }));
}

}
}
