// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

constexpr int kCoverageSeeds = 20;

/// A scene and the true irradiance of its cells, W/m2.
struct KnownScene
{
  SceneObjects objects;
  std::vector<std::vector<double>> truth; ///< of each object's cells
  /// Where it is gathered: known to rounding, or nearly, as no walk and no shadow brings noise.
  bool isExact = false;
};

/// Adds a side of n x n cells with its truth, the mean of `exact` over each cell.
template <class Function>
void addKnownQuad(ObjectBuilder& builder, std::vector<double>& truth, const Vector3& corner,
  const Vector3& u, const Vector3& v, int n, const Look& look, const Function& exact)
{
  constexpr int kPoints = 30;
  builder.addQuad(corner, u, v, n, n, look);
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      truth.push_back(meanOverRectangle(Vector3(corner + u * (double(i) / n) + v * (double(j) / n)),
        Vector3(u / n), Vector3(v / n), kPoints, exact));
    }
  }
}

double dark(const Vector3& /*point*/)
{
  return 0;
}

KnownScene furnaceScene()
{
  return { furnaceWithBall(91, 5), { std::vector<double>(96, 1.0), std::vector<double>(50, 1.0) } };
}

/// A shining square and a wall that shares an edge with it.
KnownScene perpendicularSquares()
{
  const std::vector<Vector3> source = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  KnownScene scene;
  ObjectBuilder builder;
  std::vector<double> truth;
  addKnownQuad(builder, truth, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, grey(0, 100), dark);
  addKnownQuad(
    builder, truth, { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 10, grey(0), [&](const Vector3& p) {
      return 100 * lambertIrradiance(p, { 1, 0, 0 }, source);
    });
  scene.objects = { builder.build(), {} };
  scene.isExact = true;
  scene.truth = { truth };
  return scene;
}

/// CIE 171:2006, 5.7: a shining wall behind an obstruction as wide as the room. Half of the area
/// gets no light.
KnownScene obstruction()
{
  const auto from = [](double z) {
    return std::vector<Vector3>{ { 0, 4, z }, { 4, 4, z }, { 4, 4, 3 }, { 0, 4, 3 } };
  };
  const auto onWall = [&](const Vector3& p) {
    const double edge = p[2] < 1 ? 2.5 : 2.7; // of the box, which hides what is below it
    return 100 *
      lambertIrradiance(p, { 0, 1, 0 }, from(std::max(0.0, p[2] + (1 - p[2]) * 4 / edge)));
  };
  const auto onFront = [&](const Vector3& p) {
    return 100 * lambertIrradiance(p, { 0, 1, 0 }, from(0));
  };
  const auto onTop = [&](const Vector3& p) {
    return 100 * lambertIrradiance(p, { 0, 0, 1 }, from(1));
  };
  KnownScene scene;
  ObjectBuilder room, block;
  scene.truth.resize(2);
  addKnownQuad(room, scene.truth[0], { 4, 0, 0 }, { -4, 0, 0 }, { 0, 0, 3 }, 12, grey(0), onWall);
  addKnownQuad(room, scene.truth[0], { 0, 4, 0 }, { 4, 0, 0 }, { 0, 0, 3 }, 4, grey(0, 100), dark);
  const Vector3 x(4, 0, 0), y(0, 0.2, 0), z(0, 0, 1);
  addKnownQuad(block, scene.truth[1], { 0, 2.5, 0 }, x, z, 3, grey(0), dark);
  addKnownQuad(block, scene.truth[1], { 4, 2.7, 0 }, -x, z, 6, grey(0), onFront);
  addKnownQuad(block, scene.truth[1], { 0, 2.5, 1 }, x, y, 4, grey(0), onTop);
  scene.objects = { room.build(), { block.build() } };
  return scene;
}

/// A point light off the middle of a black room.
KnownScene pointInRoom()
{
  const Vector3 light(0.7, -0.4, 0.9);
  KnownScene scene;
  ObjectBuilder room;
  scene.truth.resize(1);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      const Vector3 normal = -sign * Vector3::Unit(axis);
      const Vector3 u = 4 * Vector3::Unit((axis + 1) % 3), v = u.cross(normal) * -1;
      addKnownQuad(room, scene.truth[0], Vector3(-2 * normal - 0.5 * u - 0.5 * v), u, v, 6, grey(0),
        [&](const Vector3& p) {
          const Vector3 to = light - p;
          return 1000 / (4 * M_PI) * normal.dot(to) / std::pow(to.norm(), 3);
        });
    }
  }
  room.addPointLight(light, 1000);
  scene.isExact = true;
  scene.objects = { room.build(), {} };
  return scene;
}

/// A room with a lamp and a ball, where half of the light is reflected. The truth are 16 long runs,
/// which leave a gathered estimate's own seeds alone; with it an interval holds it by .2 % less
/// often.
KnownScene halfReflectingRoom()
{
  ObjectBuilder room = plainRoom({ 4, 3, 5 }, 4, grey(0.5));
  room.addQuad({ 1.5, 1, 4.8 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0.5, 100));
  KnownScene scene;
  scene.objects = { room.build(), { ball({ 1.5, 1.2, 2 }, 0.8, 5, grey(0.7)) } };
  scene.truth = { std::vector<double>(97), std::vector<double>(50) };
  constexpr int kRuns = 16;
  for (int run = 0; run < kRuns; ++run)
  {
    EngineSettings settings =
      Shoot(scaled(400000)).seeded(1000 + static_cast<std::uint64_t>(run)).gathered().unverified();
    UpdatedEngine engine(scene.objects, settings);
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      scene.truth[cell.object][cell.cell] += engine.irradiance({ cell, 0 }, 0) / kRuns;
    });
  }
  return scene;
}

struct NamedScene
{
  const char* name;
  std::function<KnownScene()> make;
  friend std::ostream& operator<<(std::ostream& out, const NamedScene& scene)
  {
    return out << scene.name;
  }
};

class Coverage : public testing::TestWithParam<NamedScene>
{
};

/// Calls `use(estimate, standard error, truth, area)`, W/m2, for every cell.
template <class Use>
void forEachCell(const IrradianceEngine& engine, const KnownScene& scene, const Use& use)
{
  const ErrorEstimate errors = engine.errorEstimate();
  engine.cells().numbers().forEach([&](const SceneCell& cell) {
    const double area = engine.cells().area(cell);
    use(engine.irradiance({ cell }, 0), engine.watts(errors.standardError({ cell }, 0)) / area,
      scene.truth[cell.object][cell.cell], area);
  });
}

/// Of lit cells, of cells whose errors are known, and of intervals that hold the truth.
struct Held
{
  double cells = 0, known = 0, held = 0, knownArea = 0, heldArea = 0;
};

Held countHeld(const KnownScene& scene, bool isGathered)
{
  const EngineSettings settings = Shoot(scaled(60000)).errors(16).gathered(isGathered);
  const double factor = ErrorEstimate::confidenceFactor(settings.replicates);
  Held all;
  overSeeds(scene.objects, kCoverageSeeds, settings, [&](const IrradianceEngine& engine) {
    forEachCell(engine, scene, [&](double estimate, double error, double truth, double area) {
      all.cells += truth > 0 ? 1 : 0;
      if (!std::isnan(error))
      {
        // What is gathered from a point is known to rounding.
        const bool holds = std::abs(estimate - truth) <= factor * error + 1e-6 * truth;
        all.known += 1;
        all.held += holds ? 1 : 0;
        all.knownArea += area;
        all.heldArea += holds ? area : 0;
      }
    });
  });
  return all;
}

// 20 seeds of 100 to 216 lit cells: the share of intervals that hold the truth scatters by 0.3 to
// 0.5 % and must lie within 2 % of 95 %. If it is exactly 95 %, less than 10^-4 of all choices of
// seeds raise a false alarm; at 94.5 %, 0.2 %. Samples of a net are closer to the truth than the
// scatter of its blocks says, so gathered intervals hold it more often: 96 to 99 %, which scatter
// by 0.2 to 0.4 %, and nearly always where the light of a point, or of a panel that nothing hides,
// is all there is.
TEST_P(Coverage, IntervalsHoldTheTruth)
{
  const KnownScene scene = GetParam().make();
  for (const bool isGathered : { false, true })
  {
    const Held held = countHeld(scene, isGathered);
    if (!kIsSanitized) // with sanitizers there are too few walks to know much
    {
      EXPECT_GE(held.known, 0.9 * held.cells);
      for (const double share : { held.held / held.known, held.heldArea / held.knownArea })
      {
        EXPECT_GE(share, isGathered ? 0.94 : 0.93);
        EXPECT_LE(share, !isGathered ? 0.97 : scene.isExact ? 1 : 0.998);
      }
    }
  }
}

// The target asks for 95 % of the area to be within 20 %. Apart from chance, less of the area is
// truly within it only if the intervals are too small.
TEST_P(Coverage, TargetIsReachedOnMostOfTheArea)
{
  const KnownScene scene = GetParam().make();
  const EngineSettings settings = Shoot(500).errors(16).target(kIsSanitized ? 0.5 : 0.2, 4000000);
  double within = 0, all = 0;
  overSeeds(scene.objects, kCoverageSeeds, settings, [&](const IrradianceEngine& engine) {
    EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
    EXPECT_LT(engine.numberOfWalks(), settings.maximumNumberOfWalks);
    double power = 0, area = 0;
    forEachCell(engine, scene, [&](double estimate, double, double, double cellArea) {
      power += estimate * cellArea;
      area += cellArea;
    });
    forEachCell(engine, scene, [&](double estimate, double, double truth, double cellArea) {
      const double basis = estimate > 0 ? estimate : power / area;
      const bool isInside = std::abs(estimate - truth) <= settings.targetRelativeError * basis;
      within += isInside ? cellArea : 0;
    });
    all += area;
  });
  EXPECT_GE(within, 0.95 * all);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Coverage,
  testing::Values(NamedScene{ "Furnace", furnaceScene },
    NamedScene{ "PerpendicularSquares", perpendicularSquares },
    NamedScene{ "Obstruction", obstruction }, NamedScene{ "PointInRoom", pointInRoom },
    NamedScene{ "LitRoom", halfReflectingRoom }),
  [](const auto& info) { return std::string(info.param.name); });

}
}
