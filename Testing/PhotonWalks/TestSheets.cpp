// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Sheets.h"
#include "Skies.h"

namespace irradiance::test
{
namespace
{

constexpr double kDegree = M_PI / 180;

// Values of an independent program, of a pane without absorption and of one whose transmittance is
// .88 at normal incidence.
TEST(Sheets, APaneFollowsFresnelAndBouguer)
{
  const struct
  {
    double angle, clear, grey;
  } rows[] = { { 0, .9183, .8800 }, { 10, .9183, .8797 }, { 20, .9179, .8786 },
    { 30, .9160, .8755 }, { 40, .9095, .8676 }, { 50, .8912, .8479 }, { 60, .8435, .7999 },
    { 70, .7247, .6839 }, { 75, .6148, .5774 }, { 80, .4560, .4235 }, { 85, .2456, .2189 } };
  for (const auto& row : rows)
  {
    const double cosine = std::cos(row.angle * kDegree);
    const PaneLight clear = pane(1.52, 1, cosine), grey = pane(1.52, .95842, cosine);
    EXPECT_NEAR(clear.transmitted, row.clear, 6e-5) << row.angle;
    EXPECT_NEAR(grey.transmitted, row.grey, 6e-5) << row.angle;
    EXPECT_NEAR(clear.transmitted + clear.reflected, 1, 1e-6) << row.angle;
  }
  const std::pair<double, double> reflected[] = { { 0, .0785 }, { 30, .0806 }, { 45, .0934 },
    { 60, .1500 }, { 70, .2642 }, { 80, .5243 } };
  for (const auto& [angle, part] : reflected)
  {
    EXPECT_NEAR(pane(1.52, .95842, std::cos(angle * kDegree)).reflected, part, 6e-5) << angle;
  }
  EXPECT_NEAR(paneInDiffuseLight(1.52, 1).transmitted, .84642, 2e-5);
  EXPECT_NEAR(paneInDiffuseLight(1.52, .95842).transmitted, .80555, 2e-5);
  EXPECT_EQ(pane(1.52, .9, 0).reflected, 1);
  EXPECT_EQ(pane(1, 1, 0.5).transmitted, 1);
}

class SheetModes : public BothModes
{
};

// Each cell of the floor has 4000 samples or photons or more that come through or do not; 5
// standard deviations are left.
TEST_P(SheetModes, SunComesThroughAPaneByAngle)
{
  for (const double angle : { 0., 10., 20., 30., 40., 50., 60., 70., 80., 85. })
  {
    ObjectBuilder floor;
    floor.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0));
    SceneObject above = sheet(3, 1, grey(0), { 0, {}, 1.52, .95842 });
    above.worldFromObject = shift({ 0, 0, 0.01 });
    const Sky sun =
      sunOnly(box({ -1.5, -1.5, -0.01 }, { 1.5, 1.5, 0.02 }), skyDirection(angle, 30), 1);
    Shoot shoot(scaled(1 << 15));
    shoot.gathered(isGathered()).bySide();
    shoot.fewestSamples = { 4096, 4096, 4096 };
    const UpdatedEngine engine({ floor.build(), { above }, std::make_shared<Sky>(sun) }, shoot);
    const double cosine = std::cos(angle * kDegree), part = pane(1.52, .95842, cosine).transmitted;
    const double walks = isGathered() ? 4096 : scaled(1 << 15) / 3.;
    EXPECT_NEAR(engine.irradiance({ { 0, 0 }, 0 }, 0) / cosine, part, 5 * std::sqrt(part / walks))
      << angle;
    EXPECT_EQ(engine.irradiance({ { 0, 0 }, 1 }, 0), 0);
    expectBalance(engine);
  }
}

// Stokes: n sheets that reflect r and let t through, between a black lamp and a black ceiling.
// Walls are mirrors, so that the sheets go on for ever. Of what the lamp sends 5 standard
// deviations of as many walks are left.
TEST_P(SheetModes, AStackIsTheTwoStreamSolution)
{
  const struct
  {
    double reflected, through;
    int sheets;
    double allThrough, allReflected;
  } rows[] = { { .1, .8, 2, .64646465, .16464646 }, { .1, .8, 5, .35193254, .25426929 },
    { .3, .7, 3, .43750000, .56250000 }, { .5, .4, 2, .21333333, .60666667 },
    { .5, .4, 5, .04268761, .65419932 } };
  for (const auto& row : rows)
  {
    for (const bool isStraight : { false, true })
    {
      ObjectBuilder stack;
      const Look mirror{ {}, {}, { 1, 1, 1 } };
      const double height = 0.2 * (row.sheets + 1);
      stack.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0, 1));
      stack.addQuad({ 0, 0, height }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0));
      for (int side = 0; side < 4; ++side)
      {
        stack.addSide(box({ 0, 0, 0 }, { 1, 1, height }), side, 1, mirror, true);
      }
      const std::size_t first = stack.numberOfCells();
      Look look = grey(isStraight ? 0 : row.reflected);
      look.specular[0] = isStraight ? row.reflected : 0;
      for (int i = 1; i <= row.sheets; ++i)
      {
        stack.addQuad({ 0, 0, 0.2 * i }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, look);
      }
      SceneObject object = stack.build();
      makeSheets(object, first, isStraight ? straight(row.through) : Through{ row.through });
      const std::uint32_t walks = scaled(20000);
      const UpdatedEngine engine({ object, {} }, Shoot(walks).gathered(isGathered()));
      const auto sigma = [&](double part) { return 5 * std::sqrt(part / walks); };
      EXPECT_NEAR(wattsOn(engine, 0, 1, 2), row.allThrough, sigma(row.allThrough))
        << row.sheets << isStraight;
      EXPECT_NEAR(wattsOn(engine, 0, 0, 1), row.allReflected, sigma(row.allReflected))
        << row.sheets << isStraight;
      expectBalance(engine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(DirectLight, SheetModes, testing::Bool(), nameOfMode);

/// A furnace with sheets that absorb nothing: E = 1 everywhere.
SceneObjects sheetFurnace(double step)
{
  Look shiny = grey(0.2);
  shiny.specular[0] = 0.2;
  shiny.exponent = 30;
  ObjectBuilder box1;
  box1.addBox(box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }), 1, grey(0.1));
  SceneObjects objects{ furnace(plainRoom({ 4, 3, 5 }, 3, {}), 0.6),
    { sheet(1.5, 2, shiny, { 0.3, { 0.3, 0.3, 0.3 } }), sheet(1.5, 2, grey(0), { 0, {}, 1.52, 1 }),
      box1.build() } };
  makeSheets(objects.dynamicObjects[2], 0, { 0.4, { 0.5, 0.5, 0.5 } });
  objects.dynamicObjects[0].worldFromObject = shift({ 1.5, 1.5, 3 + step });
  objects.dynamicObjects[1].worldFromObject = shift({ 2, 1.2, 4 });
  objects.dynamicObjects[2].worldFromObject = shift({ 2 - step, 1.3, 1.5 });
  return objects;
}

// Some 700 photons or rays for each side of a cell: 6 standard deviations are left, and for the
// mean of all 5.
TEST(Sheets, AFurnaceStaysOneWhateverMoves)
{
  const std::uint32_t walks = scaled(1 << 15);
  for (const EngineSettings& settings :
    { EngineSettings(Shoot(walks).bySide()), EngineSettings(Shoot(walks).gathered().bySide()),
      EngineSettings(Shoot(walks).spread(300).bySide()),
      EngineSettings(Shoot(walks).finalGather(kIsSanitized ? 64 : 1024).everywhere().bySide()) })
  {
    Execution serial;
    IrradianceEngine engine;
    for (const double step : { 0.0, 0.5 })
    {
      engine.update(sheetFurnace(step), settings, serial);
      double sum = 0, count = 0;
      forEachSide(engine.objects(), true, [&](const CellSide& side, int) {
        if (side.object > 0)
        {
          const double told = engine.irradiance(side, 0);
          EXPECT_NEAR(told, 1, kIsSanitized ? 0.9 : 0.25)
            << "object " << side.object << ", side " << side.side;
          sum += told;
          ++count;
        }
      });
      EXPECT_NEAR(sum / count, 1, kIsSanitized ? 0.2 : 0.04);
      const double unit = 1 / M_PI;
      if (settings.cellEstimate != CellEstimate::Gathered)
      {
        continue;
      }
      const std::vector<Sensor> sensors{ { { 1.5, 1.5, 2.9 + step }, { 0, 0, 1 } },
        { { 2 - step, 1.3, 1.5 }, { 0, 0, 1 } }, { { 2, 1.2, 4.1 }, { 0, 0, -1 } } };
      for (const auto& light : gathered(engine, sensors, 1024))
      {
        EXPECT_NEAR(light.value[0], 1, kIsSanitized ? 0.3 : 0.06);
      }
      const SeenLights diffuser = seen(engine, { { 3, 0 } }, Eye{ { 0.5, 0.5, 4.5 } }, 64);
      EXPECT_NEAR(diffuser[0].value[0], 0.5 * unit, 0.5 * 0.2 * unit); // less what goes straight
    }
  }
}

// Walks, direct light looked for through sheets, and rays tell the same. Rays that meet lamps by way
// of mirrors have rare large parts, which error bars do not know: so they get none.
TEST(Sheets, MethodsAgree)
{
  const std::uint32_t walks = scaled(1 << 16);
  const UpdatedEngine shot(glazedRoom(), Shoot(walks).errors(16).unverified(), ThreadExecution(2)),
    gathering(glazedRoom(), Shoot(walks).gathered().errors(16).unverified(), ThreadExecution(2));
  EXPECT_GT(expectAgreement(shot, gathering), kIsSanitized ? 40 : 100);
  const SceneObjects dull = glazedRoom(1, 0);
  const UpdatedEngine dullShot(dull, Shoot(walks).errors(16).unverified(), ThreadExecution(2)),
    rays(dull, Shoot(walks).finalGather(64).everywhere().unbiased().errors(16).unverified(),
      ThreadExecution(2));
  EXPECT_GT(expectAgreement(dullShot, rays), kIsSanitized ? 40 : 100);
}

// Into a closed body that lets light through light comes, and nothing takes its inside for dark.
TEST(Sheets, ABodyOfGlassIsLitInside)
{
  ObjectBuilder glass;
  glass.addSphere({ 0, 0, 0 }, 0.5, 6, grey(0));
  SceneObject around = glass.build(shift({ 2, 2, 1 }));
  makeSheets(around, 0, straight(0.9));
  const SceneObjects objects{ litRoom(3).build(), { around, ball({ 2, 2, 1 }, 0.2, 3) } };
  for (const bool isGathered : { false, true })
  {
    const UpdatedEngine engine(objects, Shoot(scaled(1 << 14)).gathered(isGathered).bySide());
    double inside = 0, outside = 0;
    for (std::size_t cell = 0; cell < objects.dynamicObjects[0].material->numberOfCells; ++cell)
    {
      outside += engine.irradiance({ { 1, cell }, 0 }, 0);
      inside += engine.irradiance({ { 1, cell }, 1 }, 0);
    }
    EXPECT_GT(inside, 0.5 * outside);
    EXPECT_GT(wattsOn(engine, 2, 0, 12), 0);
  }
}

}
}
