// SPDX-License-Identifier: BSD-3-Clause
// Sun and sky against published numbers: the light of the table by a quadrature of its own.

#include "SkyOf.h"

#include "ErrorObserver.h"

using Direction = SkyOf::Direction;

namespace
{

vtkSmartPointer<vtkSunSkySource> MakeSky(int model, double altitude, double azimuth = 180)
{
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetSkyModel(model);
  source->SetSunAltitude(altitude);
  source->SetSunAzimuth(azimuth);
  return source;
}

vtkSmartPointer<vtkSunSkySource> MakeCIESky(int type, double altitude, double azimuth)
{
  auto source = MakeSky(
    type == 16 ? vtkSunSkySource::CIEOvercast : vtkSunSkySource::CIEGeneral, altitude, azimuth);
  source->SetCIEType(std::min(type, 15));
  return source;
}

constexpr Direction kUp{ 0, 0, 1 };

double AltitudeOf(const Direction& d)
{
  return vtkMath::DegreesFromRadians(std::asin(d[2]));
}

double AzimuthOf(const Direction& d)
{
  const double azimuth = vtkMath::DegreesFromRadians(std::atan2(d[0], d[1]));
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

/// Where NREL's algorithm has its example.
vtkSmartPointer<vtkSunSkySource> MakeGolden(const char* time)
{
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetSunFromToPlaceAndTime();
  source->SetLatitude(39.742476);
  source->SetLongitude(-105.1786);
  source->SetTimeZone(-7);
  source->SetDateTime(time);
  return source;
}

}

// Reda and Andreas, Solar Energy 76:577, 2004: without refraction.
TEST(SunSky, FindsTheSun)
{
  const struct
  {
    const char* Time;
    double Altitude, Azimuth;
  } examples[] = {
    { "2003-10-17 12:30:30", 39.872046, 194.340241 },
    { "2003-10-18T12:30:30", 39.505196, 194.311132 },
  };
  for (const auto& example : examples)
  {
    const SkyOf sky(MakeGolden(example.Time));
    EXPECT_NEAR(AltitudeOf(sky.Sun), example.Altitude, 0.01);
    EXPECT_NEAR(AzimuthOf(sky.Sun), example.Azimuth, 0.01);
  }
  // The formula itself, as it was computed elsewhere.
  const SkyOf sky(MakeGolden("2003-10-17 12:30:30"));
  EXPECT_NEAR(AltitudeOf(sky.Sun), 90 - 50.12717, 1e-4);
  EXPECT_NEAR(AzimuthOf(sky.Sun), 194.33697, 1e-4);
}

// When it rises and sets half of its disc and refraction take .83 degrees. The sun is in the east,
// then in the west. (Tables by the day of UT list the last one for August 2.)
TEST(SunSky, RisesAndSets)
{
  const struct
  {
    const char* Time;
    bool IsMorning;
  } ends[] = { { "2015-01-02 07:21:55", true }, { "2015-01-02 16:47:43", false },
    { "2015-08-02 05:00:27", true }, { "2015-08-01 19:13:58", false } };
  for (const auto& end : ends)
  {
    const SkyOf sky(MakeGolden(end.Time));
    EXPECT_NEAR(AltitudeOf(sky.Sun), -0.833, 0.03) << end.Time;
    EXPECT_EQ(sky.Sun[0] > 0, end.IsMorning) << end.Time;
  }
}

// The scene's axes: x east, y north; or turned.
TEST(SunSky, StandsInTheFrameOfTheScene)
{
  auto source = MakeSky(vtkSunSkySource::CIEClear, 30, 90);
  source->SetDirectNormalIrradiance(700);
  SkyOf sky(source);
  EXPECT_NEAR(sky.Sun[0], std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(sky.Sun[1], 0, 1e-12);
  EXPECT_NEAR(sky.Sun[2], 0.5, 1e-12);
  EXPECT_EQ(sky.SunIrradiance, 700);
  EXPECT_EQ(sky.SunRadius, 0.2666);
  EXPECT_GT(sky.At(60, 90), 5 * sky.At(60, 270));
  source->SetNorth(60); // y points to north-east by east
  sky = SkyOf(source);
  EXPECT_NEAR(AzimuthOf(sky.Sun), 30, 1e-10);
  EXPECT_EQ(std::max_element(sky.Radiance.begin(), sky.Radiance.end()) - sky.Radiance.begin(),
    (std::lower_bound(sky.Azimuths.begin(), sky.Azimuths.end(), 30 - 1e-9) - sky.Azimuths.begin()) *
        static_cast<std::ptrdiff_t>(sky.PolarAngles.size()) +
      (std::lower_bound(sky.PolarAngles.begin(), sky.PolarAngles.end(), 60 - 1e-9) -
        sky.PolarAngles.begin()));
}

// ISO 15469; the horizontal irradiance over the radiance of the zenith, from fine quadratures.
TEST(SunSky, HasTheSkiesOfCIE)
{
  const double ratios[16] = { 2.4495, 2.0860, 2.7700, 2.3154, 3.1416, 2.5842, 2.4212, 2.3284,
    3.4593, 3.1703, 2.9891, 3.1906, 3.0259, 3.2170, 3.0159, 2.4435 };
  for (int type = 1; type <= 16; ++type)
  {
    for (const double azimuth : { 180., 0., 123.456 })
    {
      const SkyOf sky(MakeCIESky(type, 60, azimuth));
      EXPECT_NEAR(sky.Irradiance(kUp), 100, 1e-4) << type;
      EXPECT_NEAR(100 / sky.At(0, 0), ratios[type - 1], 1e-3 * ratios[type - 1]) << type;
    }
  }
}

TEST(SunSky, LightsTiltedPlanes)
{
  const struct
  {
    int Model;
    double Irradiance[5]; ///< at 0, 30, 45, 60, 90 degrees, for 1 W/m2/sr in the zenith
  } skies[] = {
    { vtkSunSkySource::Uniform, { 3.141593, 2.931146, 2.681517, 2.356194, 1.570796 } },
    { vtkSunSkySource::CIEOvercast, { 2.443461, 2.206937, 1.948589, 1.635719, .968043 } },
  };
  const double tilts[5] = { 0, 30, 45, 60, 90 };
  for (const auto& expected : skies)
  {
    auto source = MakeSky(expected.Model, 45);
    source->SetDiffuseHorizontalIrradiance(expected.Irradiance[0]);
    const SkyOf sky(source);
    EXPECT_EQ(sky.Azimuths, std::vector<double>{ 0 });
    for (int i = 0; i < 5; ++i)
    {
      EXPECT_NEAR(sky.Irradiance(SkyOf::Towards(tilts[i], 20)) / expected.Irradiance[i], 1, 1e-3);
    }
  }
}

// Six inputs, their parameters, and the light of the model from a fine quadrature. The distance of
// the sun is the mean one.
TEST(SunSky, HasTheSkyOfPerez)
{
  const struct
  {
    double Direct, Diffuse, Altitude;
    double P[5], Integral, Zenith, AtSun, Towards, Away;
  } cases[] = {
    { 840, 135, 60, { -.96492, -.17568, 21.51984, -5.46104, 1.40865 }, 2.187006, 38.6916, 313.494,
      103.256, 51.083 },
    { 720, 280, 60, { -.79578, -.48363, 12.72291, -3.51619, .15444 }, 4.588416, 97.4237, 461.305,
      177.935, 81.991 },
    { 0, 80, 60, { 1.14868, -.68502, .15625, -.16760, -.03311 }, 4.891587, 28.8789, 27.935, 35.280,
      35.225 },
    { 600, 120, 30, { -.96623, -.32567, 13.08629, -3.41330, .31740 }, 2.841710, 18.4641, 301.848,
      146.736, 45.599 },
    { 300, 200, 30, { -1.10582, -.78134, 11.92616, -3.13128, .08516 }, 4.253966, 34.1360, 469.959,
      215.983, 63.752 },
    { 200, 60, 10, { -1.29953, -.63711, 10.35042, -3.18034, -.02702 }, 2.535748, 8.2981, 259.051,
      84.744, 26.802 },
  };
  for (const auto& c : cases)
  {
    auto source = MakeSky(vtkSunSkySource::Perez, c.Altitude, 230);
    source->SetDirectNormalIrradiance(c.Direct);
    source->SetDiffuseHorizontalIrradiance(c.Diffuse);
    const SkyOf sky(source);
    const double sunZenith = 90 - c.Altitude;
    EXPECT_NEAR(sky.Irradiance(kUp) / c.Diffuse, 1, 1e-5);
    EXPECT_NEAR(sky.At(0, 0) / c.Zenith, 1, 2e-3);
    EXPECT_NEAR(sky.At(sunZenith, 230) / c.AtSun, 1, 2e-3);
    EXPECT_NEAR(sky.Irradiance(SkyOf::Towards(90, 230)) / c.Towards, 1, 5e-3);
    EXPECT_NEAR(sky.Irradiance(SkyOf::Towards(90, 50)) / c.Away, 1, 5e-3);
    const Direction toSun = SkyOf::Towards(sunZenith, 230);
    for (const double polar : { 0., 20., 55., 80. })
    {
      for (const double azimuth : { 10., 240., 290. })
      {
        const double chi =
          std::acos(vtkMath::Dot(SkyOf::Towards(polar, azimuth).data(), toSun.data()));
        const double l =
          (1 + c.P[0] * std::exp(c.P[1] / std::cos(vtkMath::RadiansFromDegrees(polar)))) *
          (1 + c.P[2] * std::exp(c.P[3] * chi) + c.P[4] * std::cos(chi) * std::cos(chi));
        EXPECT_NEAR(sky.At(polar, azimuth) / (l * c.Diffuse / c.Integral), 1, 5e-3)
          << polar << " " << azimuth << " " << c.Altitude;
      }
    }
  }
}

// The extraterrestrial irradiance follows the day: early in January it is 3.5 % above the mean.
TEST(SunSky, KnowsTheDistanceOfTheSun)
{
  const auto ratio = [](const char* time, double meanDiffuse) {
    auto source = MakeGolden(time);
    source->SetDirectNormalIrradiance(0);
    source->SetDiffuseHorizontalIrradiance(80);
    const SkyOf sky(source);
    auto mean = MakeSky(vtkSunSkySource::Perez, AltitudeOf(sky.Sun));
    mean->SetDiffuseHorizontalIrradiance(meanDiffuse);
    return sky.At(0, 0) / sky.At(85, 0) / (SkyOf(mean).At(0, 0) / SkyOf(mean).At(85, 0));
  };
  EXPECT_NEAR(ratio("2003-01-01 12:00", 80 / 1.03505), 1, 1e-4);
  EXPECT_GT(std::abs(ratio("2003-01-01 12:00", 80) - 1), 1e-3);
}

TEST(SunSky, HasAGround)
{
  auto source = MakeSky(vtkSunSkySource::Perez, 30);
  source->SetDirectNormalIrradiance(600);
  source->SetDiffuseHorizontalIrradiance(120);
  source->SetGroundReflectance(0.3);
  SkyOf sky(source);
  EXPECT_NEAR(sky.Irradiance({ 0, 0, -1 }, 180), 0.3 * 420, 0.01);
  EXPECT_NEAR(sky.Irradiance(kUp), 120, 1e-3);
  EXPECT_EQ(std::count(sky.PolarAngles.begin(), sky.PolarAngles.end(), 90.), 2);
  EXPECT_EQ(sky.PolarAngles.back(), 180);
  source->GroundOff();
  sky = SkyOf(source);
  EXPECT_EQ(sky.PolarAngles.back(), 90);
  EXPECT_NEAR(sky.Irradiance(kUp), 120, 1e-3);
}

// CIE 171:2006, 5.9, computed exactly: a black room of 4 x 4 x 3 m with an open roof, the sun on
// the side of +y. So it is known to which side the sky is turned.
TEST(SunSky, LightsARoomThroughItsRoof)
{
  const struct
  {
    int Type;
    double Side;                ///< of the opening
    double A, C, F, G, I, L, N; ///< % of the horizontal irradiance
  } rooms[] = {
    { 1, 1, .46, 2.34, 1.47, 2.34, 3.84, 3.84, 2.34 },
    { 5, 1, 1.04, 2.59, 1.27, 1.96, 3.05, 3.05, 1.96 },
    { 12, 1, 1.74, 4.55, 3.63, 5.72, 5.11, 2.03, .96 },
    { 13, 1, 1.61, 4.87, 4.26, 6.76, 5.79, 1.99, .86 },
    { 16, 1, .56, 2.32, 1.43, 2.29, 3.82, 3.82, 2.29 },
    { 1, 4, 35.82, 26.79, 14.36, 31.86, 41.25, 41.25, 31.86 },
    { 12, 4, 67.28, 44.20, 24.20, 42.28, 43.49, 29.23, 16.80 },
  };
  for (const auto& room : rooms)
  {
    const SkyOf sky(MakeCIESky(room.Type, 60, 0));
    const auto light = [&](const Direction& place, const Direction& normal) {
      const int n = 200;
      double sum = 0;
      for (int i = 0; i < n * n; ++i)
      {
        Direction to{ 2 + room.Side * ((i % n + .5) / n - .5) - place[0],
          2 + room.Side * ((i / n + .5) / n - .5) - place[1], 3 - place[2] };
        const double distance = vtkMath::Normalize(to.data());
        const double polar = vtkMath::DegreesFromRadians(std::acos(to[2]));
        sum += sky.At(polar, AzimuthOf(to)) * to[2] *
          std::max(0., vtkMath::Dot(to.data(), normal.data())) / (distance * distance);
      }
      return sum * room.Side * room.Side / (n * n); // of 100 W/m2, so in %
    };
    const auto wall = [&](double z) { return light({ 2, 0, z }, { 0, 1, 0 }); };
    const auto floor = [&](double y) { return light({ 2, y, 0 }, kUp); };
    const double digit = room.Side > 1 ? 0.03 : 0.008;
    EXPECT_NEAR(wall(2.75), room.A, digit) << room.Type;
    EXPECT_NEAR(wall(1.75), room.C, digit) << room.Type;
    EXPECT_NEAR(wall(0.25), room.F, digit) << room.Type;
    EXPECT_NEAR(floor(0.25), room.G, digit) << room.Type;
    EXPECT_NEAR(floor(1.25), room.I, digit) << room.Type;
    EXPECT_NEAR(floor(2.75), room.L, digit) << room.Type;
    EXPECT_NEAR(floor(3.75), room.N, digit) << room.Type;
  }
}
