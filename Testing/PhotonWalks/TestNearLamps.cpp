// SPDX-License-Identifier: BSD-3-Clause
// Lamps where they are hard to gather from: near a surface, long, in a corner, on what they light,
// around all of it.

#include "Kit.h"
#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

// |t| > 3.5 with 63 degrees of freedom happens by chance in 0.09 % of the comparisons.
constexpr int kLampSeeds = 64;
constexpr double kFlux = 10;

class NearLamps : public BothModes
{
protected:
  /// What the cells of the static object receive, W, of so many walks.
  static std::vector<ReplicateMean> received(const SceneObjects& objects, std::uint32_t walks)
  {
    std::vector<ReplicateMean> cells(objects.staticObject.material->numberOfCells);
    overSeeds(objects, kLampSeeds, walks, [&](const IrradianceEngine& engine) {
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
      {
        cells[cell].add(wattsOn(engine, 0, cell, cell + 1));
      }
    });
    return cells;
  }
};

/// Watts on each cell of a static object, from those on each triangle.
template <class Watts>
std::vector<double> onCells(const SceneObject& object, const Watts& watts)
{
  std::vector<double> cells(object.material->numberOfCells, 0.0);
  for (std::size_t i = 0; i < object.mesh().size(); ++i)
  {
    cells[object.material->cellOfTriangle[i]] += watts(object.mesh()[i]);
  }
  return cells;
}

/// Student's t. What is gathered from a point is known to rounding; lights are clear of surfaces by
/// 2^-33 of the coordinates.
double tOf(const ReplicateMean& estimate, double truth)
{
  return std::abs(estimate.mean() / truth - 1) < 1e-6 ? 0 : estimate.t(truth);
}

/// Cells of which 100 walks or more would hit one, of all seeds together, one by one and together:
/// chance exceeds the limit once in 10^4 (cells taken as independent).
void expectCells(
  const std::vector<ReplicateMean>& cells, const std::vector<double>& truth, std::uint32_t walks)
{
  double chiSquare = 0, count = 0, sum = 0, expected = 0;
  for (std::size_t cell = 0; cell < truth.size(); ++cell)
  {
    sum += cells[cell].mean();
    expected += truth[cell];
    if (truth[cell] == 0)
    {
      EXPECT_EQ(cells[cell].mean(), 0) << "cell " << cell;
    }
    else if (truth[cell] / kFlux * walks * kLampSeeds > 100)
    {
      const double t = tOf(cells[cell], truth[cell]);
      chiSquare += t * t;
      ++count;
    }
  }
  const double freedom = kLampSeeds - 1;
  EXPECT_GT(count, kIsSanitized ? 1 : 5);
  EXPECT_LE(chiSquare * (freedom - 2) / freedom, 1.1 * chiSquareLimit(count, 3.72));
  EXPECT_NEAR(sum, expected, (kIsSanitized ? 0.1 : 0.01) * expected);
}

/// Points of [0, 1] and their weights: Gauss' rule of three points in each of so many parts.
std::vector<std::pair<double, double>> gaussPoints(int parts)
{
  std::vector<std::pair<double, double>> points;
  for (int part = 0; part < parts; ++part)
  {
    for (const int side : { -1, 0, 1 })
    {
      const double place = part + 0.5 + side * std::sqrt(0.15);
      points.emplace_back(place / parts, (side == 0 ? 8.0 : 5.0) / 18 / parts);
    }
  }
  return points;
}

struct Rectangle
{
  Vector3 corner, u, v;
};

// By reciprocity a cell receives what Lambert's formula says at the lamp's points, in the mean.
TEST_P(NearLamps, ByLambertsFormula)
{
  const struct
  {
    const char* name;
    Rectangle lamp;
    int nu, nv; ///< parts of the mean
  } lamps[] = { { ".05 m over the floor", { { 1.5, 1.5, 0.05 }, { 0, 0.05, 0 }, { 0.05, 0, 0 } }, 5,
                  5 },
    { ".01 m over the floor", { { 1.5, 1.5, 0.01 }, { 0, 0.05, 0 }, { 0.05, 0, 0 } }, 3, 3 },
    { "strip along a wall", { { 0.05, 0.2, 1.47 }, { 0, 0, 0.02 }, { 0, 3.6, 0 } }, 3, 80 },
    { "in the plane of the ceiling", { { 1.5, 1.5, 3 }, { 0, 1, 0 }, { 1, 0, 0 } }, 6, 6 },
    { "a panel", { { 1.5, 1.5, 2 }, { 0, 1, 0 }, { 1, 0, 0 } }, 6, 6 } };
  for (const auto& [name, lamp, nu, nv] : lamps)
  {
    SCOPED_TRACE(name);
    ObjectBuilder room = plainRoom({ 4, 4, 3 }, 6, grey(0));
    const Vector3 normal = lamp.u.cross(lamp.v), unit = normal.normalized();
    const SceneObject walls = room.build();
    const std::vector<double> truth =
      onCells(walls, [&, nu = nu, nv = nv, &lamp = lamp](const Triangle& triangle) {
        double sum = 0;
        for (const auto& [u, weightU] : gaussPoints(nu))
        {
          for (const auto& [v, weightV] : gaussPoints(nv))
          {
            const Vector3 point = lamp.corner + lamp.u * u + lamp.v * v;
            sum += weightU * weightV *
              lambertIrradiance(
                point, unit, aboveHorizon({ triangle.a, triangle.b, triangle.c }, point, unit));
          }
        }
        return kFlux * sum;
      });
    room.addQuad(lamp.corner, lamp.u, lamp.v, 1, 1, grey(0, kFlux / normal.norm()));
    const std::uint32_t walks = scaled(40000);
    expectCells(received({ room.build(), {} }, walks), truth, walks);
  }
}

// A cell receives its solid angle; in a corner, of the eighth of a sphere that is open.
TEST_P(NearLamps, PointLights)
{
  const struct
  {
    Vector3 position;
    double sphere; ///< sr
  } lights[] = { { { 1, 3, 0.5 }, 4 * M_PI }, { { 1, 3, 0.01 }, 4 * M_PI },
    { { 1, 0, 0.5 }, 2 * M_PI }, { { 0, 0, 3 }, 0.5 * M_PI } };
  for (const auto& [position, sphere] : lights)
  {
    SCOPED_TRACE(testing::Message() << "at " << position.transpose());
    ObjectBuilder room = plainRoom({ 4, 4, 3 }, 6, grey(0));
    const std::vector<double> truth =
      onCells(room.build(), [&, &position = position, sphere = sphere](const Triangle& triangle) {
        const double height = triangle.areaVector().normalized().dot(position - triangle.a);
        return std::abs(height) < 1e-9 ? 0 : kFlux * solidAngleOf(triangle, position) / sphere;
      });
    room.addPointLight(position, kFlux);
    const std::uint32_t walks = scaled(30000);
    expectCells(received({ room.build(), {} }, walks), truth, walks);
  }
}

// A black box of 1 x 1 m stands on a light table of 3 x 3 m. Its bottom receives what the table
// emits; a row of its sides what Lambert's formula says of the part of the table before it.
TEST_P(NearLamps, APartOnALightTable)
{
  ObjectBuilder table, part;
  table.addQuad({ -1.5, -1.5, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 3, 3, grey(0, 2));
  part.addBox(box({ -0.5, -0.5, 0 }, { 0.5, 0.5, 1 }), 2, grey(0));
  const std::vector<Vector3> before{ { 0.5, -1.5, 0 }, { 1.5, -1.5, 0 }, { 1.5, 1.5, 0 },
    { 0.5, 1.5, 0 } };
  double rows[2] = { 0, 0 }; // of cells, lower and upper
  for (int row = 0; row < 2; ++row)
  {
    rows[row] = 2 *
      meanOverRectangle(
        { 0.5, -0.5, 0.5 * row }, { 0, 0.5, 0 }, { 0, 0, 0.5 }, 200, [&](const Vector3& p) {
          return lambertIrradiance(p, { 1, 0, 0 }, before);
        });
  }
  const SceneObject standing = part.build();
  std::vector<double> heights(24, 0); // of each cell's highest corner
  for (std::size_t i = 0; i < standing.mesh().size(); ++i)
  {
    const Triangle triangle = standing.mesh()[i];
    double& height = heights[standing.material->cellOfTriangle[i]];
    height = std::max({ height, triangle.a[2], triangle.b[2], triangle.c[2] });
  }
  ReplicateMean bottom, lower, upper, top;
  overSeeds({ table.build(), { standing } }, kLampSeeds, scaled(30000),
    [&](const IrradianceEngine& engine) {
      double onSides[2] = { 0, 0 };
      for (std::size_t cell = 0; cell < 16; ++cell)
      {
        onSides[heights[cell] > 0.5 ? 1 : 0] += engine.irradiance({ { 1, cell } }, 0) / 8;
      }
      lower.add(onSides[0]);
      upper.add(onSides[1]);
      bottom.add(wattsOn(engine, 1, 16, 20));
      top.add(wattsOn(engine, 1, 20, 24));
    });
  EXPECT_LE(std::abs(tOf(bottom, 2)), 3.5);
  EXPECT_LE(std::abs(lower.t(rows[0])), 3.5);
  EXPECT_LE(std::abs(upper.t(rows[1])), 3.5);
  EXPECT_EQ(top.mean(), 0);
}

// E = M / (1 - rho) in every cell: a lamp of the whole inside of a box, that reflects its own
// light.
TEST_P(NearLamps, InAClosedBodyLightStaysInside)
{
  ObjectBuilder room, body;
  room.addBox(box({ -3, -3, -3 }, { 3, 3, 3 }), 3, grey(0.5), true);
  body.addBox(box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }), 2, grey(0.6, 1), true);
  ReplicateMean all;
  std::vector<ReplicateMean> cells(24);
  overSeeds({ room.build(), { body.build() } }, kLampSeeds, scaled(30000),
    [&](const IrradianceEngine& engine) {
      EXPECT_EQ(wattsOn(engine, 0, 0, 54), 0);
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
      {
        cells[cell].add(engine.irradiance({ { 1, cell } }, 0));
      }
      all.add(wattsOn(engine, 1, 0, 24) / 6);
    });
  for (const ReplicateMean& cell : cells)
  {
    EXPECT_LE(std::abs(cell.t(2.5)), 3.5);
  }
  EXPECT_LE(std::abs(all.t(2.5)), 3.5);
}

// Lights near to what may move are gathered, however near they are. |t| > 3.5 of 63 degrees of
// freedom, but for what lights and cells are clear of surfaces.
TEST(NearLampsOfAFloorThatMayMove, BringAllPower)
{
  const Box walls = box({ 0, 0, 0 }, { 4, 4, 3 });
  for (const double height : { 0.05, 0.01 })
  {
    ObjectBuilder room, floor;
    for (const int side : { 0, 1, 2, 3, 5 })
    {
      room.addSide(walls, side, 6, grey(0), true);
    }
    floor.addSide(walls, 4, 6, grey(0), true);
    addPanel(room, { 1.5, 1.5, height }, 0.05, 0.05, 1000);
    const SceneObjects objects{ room.build(), { floor.build() } };
    ReplicateMean received;
    overSeeds(objects, 64, Shoot(scaled(100000)).gathered(), [&](const IrradianceEngine& engine) {
      EXPECT_EQ(engine.walks().sets().size(), 2u);
      received.add(wattsOn(engine, 0, 0, objects.staticObject.material->numberOfCells) +
        wattsOn(engine, 1, 0, 36));
    });
    EXPECT_TRUE(std::abs(received.t(2.5)) <= 3.5 || std::abs(received.mean() / 2.5 - 1) < 1e-7);
    EXPECT_NEAR(received.mean(), 2.5, (kIsSanitized ? 1 : 0.02) * 2.5);
  }
}

INSTANTIATE_TEST_SUITE_P(DirectLight, NearLamps, testing::Bool(), nameOfMode);

}
}
