// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/LampScenes.h"

#include "../../PhotonWalks/Skies.h"
#include "../../PhotonWalks/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace irradiance;

namespace
{

constexpr double kDegree = M_PI / 180;

/// Two lobes of different width and strength, aside of the axis.
double lopsidedIntensity(double polar, double azimuth)
{
  const Vector3 direction(
    std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
  const auto lobe = [&](const Vector3& axis, double exponent) {
    return std::pow(std::max(0.0, direction.dot(axis.normalized())), exponent);
  };
  return polar >= M_PI / 2
    ? 0
    : direction.z() * (0.2 + lobe({ 0.7, 0.2, 1 }, 8) + 0.6 * lobe({ -0.4, 0.5, 1 }, 4));
}

/// It shines down. The polar angles are from 0 to `last` degrees.
Luminaire makeLuminaire(int polarAngles, double last, int azimuths, double watts)
{
  std::vector<double> polar, around, values;
  for (int i = 0; i < polarAngles; ++i)
  {
    polar.push_back(last * i / (polarAngles - 1));
  }
  for (int j = 0; j < azimuths; ++j)
  {
    around.push_back(360.0 * j / (azimuths - 1));
    for (const double angle : polar)
    {
      values.push_back(lopsidedIntensity(angle * kDegree, around.back() * kDegree));
    }
  }
  const auto table = std::make_shared<const DirectionTable>(polar, around, values);
  return { table, -Vector3::UnitZ(), Vector3::UnitX(), { watts }, {} };
}

/// Its front looks down.
void addPanel(test::ObjectBuilder& room, const Vector3& corner, double x, double y, double exitance)
{
  room.addQuad(corner, { 0, y, 0 }, { x, 0, 0 }, 1, 1, test::grey(0, exitance));
}

/// Around everything.
Box litBox(const Box& bounds)
{
  return test::box(bounds.lower - Vector3(0.1, 0.1, 0.1), bounds.upper + Vector3(0.1, 0.1, 0.1));
}

/// North is +y, the sun rises at 6 and is 45 degrees high at noon.
Vector3 towardsSun(double hour)
{
  const double angle = (hour - 6) * M_PI / 12;
  return { std::cos(angle), -std::sin(angle) * M_SQRT1_2, std::sin(angle) * M_SQRT1_2 };
}

/// The shape of the CIE's clear sky.
double clearRadiance(const Vector3& from, const Vector3& sun)
{
  const double cosine = std::clamp(sun.dot(from), -1.0, 1.0), angle = std::acos(cosine);
  const double gradation = 1 - (from.z() > 0 ? std::exp(-0.32 / from.z()) : 0);
  return gradation *
    (1 + 10 * (std::exp(-3 * angle) - std::exp(-1.5 * M_PI)) + 0.45 * cosine * cosine);
}

Sky makeDaylight(const Box& lit, const Vector3& sun)
{
  constexpr double kSunRadius = 0.2665 * kDegree;
  constexpr double kSky = 100 * M_1_PI, kSun = 800; // W/m2/sr for each unit of the shape, W/m2
  Sky sky = test::skyOf(
    lit, [&](const Vector3& from) { return kSky * sun.z() * clearRadiance(from, sun); });
  sky.towardsSun = sun;
  sky.sunIrradiance = { kSun * sun.z() };
  sky.sunRadius = kSunRadius;
  return sky;
}

/// Twelve modules of 1 x 2 m in a row along y, with four cells each, that turn about it.
SceneObject makeTracker()
{
  test::ObjectBuilder tracker;
  for (int i = 0; i < 12; ++i)
  {
    tracker.addBox(
      test::box({ -1, 1.05 * i, -0.02 }, { 1, 1.05 * i + 1, 0.02 }), 2, test::grey(0.1));
  }
  return tracker.build();
}

}

SceneObjects makePanelRoom(bool hasTable)
{
  constexpr double kWatts = 100;
  test::ObjectBuilder room, ball;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), 14, test::grey(0.5), true);
  const std::size_t first = room.numberOfCells();
  addPanel(room, { 1.5, 1.5, 2.95 }, 1, 1, kWatts);
  if (hasTable)
  {
    room.addOpening(first, makeLuminaire(181, 180, 73, kWatts));
  }
  ball.addSphere({ 1.2, 2.3, 1.1 }, 0.3, 39, test::grey(0.5));
  return { room.build(), { ball.build() } };
}

SceneObjects makeOffice()
{
  test::ObjectBuilder room;
  room.addBox(test::box({ 0, 0, 0 }, { 8, 6, 2.8 }), 36, test::grey(0.6), true);
  for (int i = 0; i < 6; ++i)
  {
    const Vector3 corner(0.8 + 2.6 * (i % 3), 1 + 2.6 * (i / 3), 0.7);
    room.addBox(test::box(corner, corner + Vector3(1.6, 0.8, 0.04)), 8, test::grey(0.4));
  }
  const Luminaire lamp = makeLuminaire(25, 90, 20, 30);
  for (int i = 0; i < 12; ++i)
  {
    const std::size_t first = room.numberOfCells();
    addPanel(room, { 0.7 + 2 * (i % 4), 0.7 + 2 * (i / 4), 2.75 }, 0.6, 0.6, 1);
    room.addOpening(first, lamp);
  }
  return { room.build(), {} };
}

SceneObjects makeStreet(Sky sky)
{
  constexpr int kColumns = 71, kRows = 20;
  constexpr double kCell = 2;
  const auto isBuilt = [](int i, int j) {
    return i % 7 >= 2 && ((j >= 3 && j < 7) || (j >= 13 && j < 17));
  };
  test::ObjectBuilder street;
  for (int j = 0; j < kRows; ++j)
  {
    for (int i = 0; i < kColumns; ++i)
    {
      if (!isBuilt(i, j))
      {
        street.addQuad(
          { i * kCell, j * kCell, 0 }, { kCell, 0, 0 }, { 0, kCell, 0 }, 1, 1, test::grey(0.2));
      }
    }
  }
  for (int house = 0; house < 20; ++house)
  {
    const double x = kCell * (2 + 7 * (house / 2)), y = kCell * (house % 2 == 0 ? 3 : 13);
    for (const int side : { 0, 1, 2, 3, 5 })
    {
      street.addSide(test::box({ x, y, 0 }, { x + 5 * kCell, y + 4 * kCell, 6.0 + house % 3 * 2 }),
        side, 6, test::grey(0.5));
    }
  }
  SceneObjects objects{ street.build(), {} };
  sky.lit = litBox(objects.staticObject.worldBounds());
  objects.sky = std::make_shared<const Sky>(std::move(sky));
  return objects;
}

SceneObjects makeTrackers(double hour)
{
  static const SceneObject tracker = makeTracker(), ground = [] {
    test::ObjectBuilder builder;
    builder.addQuad({ 0, 0, 0 }, { 40, 0, 0 }, { 0, 80, 0 }, 40, 40, test::grey(0.2));
    return builder.build();
  }();
  const Vector3 sun = towardsSun(hour);
  const bool isDay = sun.z() > 0.01;
  const double turn = isDay ? std::clamp(std::atan2(sun.x(), sun.z()), -1.0, 1.0) : 0;
  SceneObjects objects{ ground, {} };
  for (int i = 0; i < 40; ++i)
  {
    SceneObject placed = tracker;
    placed.worldFromObject = { Eigen::AngleAxisd(turn, Vector3::UnitY()).toRotationMatrix(),
      { 2 + 5.0 * (i % 8), 4 + 15.0 * (i / 8), 1.5 } };
    objects.dynamicObjects.push_back(std::move(placed));
  }
  if (isDay)
  {
    const Box lit = test::box({ -1, -1, -0.1 }, { 41, 81, 3 });
    objects.sky = std::make_shared<const Sky>(makeDaylight(lit, sun));
  }
  return objects;
}
