// SPDX-License-Identifier: BSD-3-Clause
// Lamps with a table of radiant intensity: the contract of the field data, in a black room. What
// the engine makes of them is tested with the engine.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkDiskSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace TestScenes;

namespace
{

constexpr double Flux = 24;
/// Down, mostly to x, and more to -y than to y.
const std::vector<double> Polar{ 0, 90 }, Azimuths{ 0, 90, 180, 270, 360 },
  Values{ 1, 4, 1, 1, 1, 0, 1, 2, 1, 4 };

void SetFlux(vtkPolyData* lamp, const std::vector<double>& flux)
{
  SetFieldTuple(lamp, "Flux", flux);
}

Mesh WithTable(const Mesh& lamp, const std::vector<double>& flux = { Flux })
{
  SetField(lamp, "RadiantIntensity", Values);
  SetField(lamp, "PolarAngles", Polar);
  SetField(lamp, "AzimuthAngles", Azimuths);
  SetFlux(lamp, flux);
  return lamp;
}

Mesh MakeVertex(const Vector& position)
{
  Mesh vertex = MakePointLight(position, { 1 });
  vertex->GetCellData()->RemoveArray("RadiantFlux");
  return vertex;
}

/// Shines down.
Mesh MakeSquare(const Vector& at, double side = 0.01)
{
  return MakeRectangle(
    { at[0] - side / 2, at[1] - side / 2, at[2] }, { 0, side, 0 }, { side, 0, 0 }, 2);
}

Mesh MakeBoxAt(const Vector& at)
{
  return Placed(MakeBox(0.01, 0.02, 0.01), 1, at);
}

/// The kinds of lamps, at a place.
std::vector<Mesh> MakeLamps(const Vector& at)
{
  return { WithTable(MakeVertex(at)), WithTable(MakeSquare(at)), WithTable(MakeBoxAt(at)) };
}

/// A black room of 4 m; lamps are in its middle.
Scene MakeBlackRoom(const std::vector<Mesh>& lamps)
{
  Scene scene{ { MakeRoom(4, 1) }, {} };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0 });
  scene.Fixed.insert(scene.Fixed.end(), lamps.begin(), lamps.end());
  return scene;
}

const Vector Middle{ 2, 2, 2 };

/// W on the floor, the ceiling, and the walls x = 0, x = 4, y = 0, y = 4.
using Walls = std::array<double, 6>;

Walls FoundBy(const Scene& scene)
{
  auto filter = MakeFilter(scene, 20000);
  ExpectNothing(Update(filter));
  Walls watts{};
  for (vtkIdType i = 0; i < 6; ++i)
  {
    watts[static_cast<std::size_t>(i)] = 16 * IrradianceOf(filter, 0, 0)->GetComponent(i, 0);
  }
  return watts;
}

/// From the middle a ray goes to the wall of its longest component. `toWorld`: of a direction.
Walls Expected(const std::function<Vector(const Vector&)>& toWorld)
{
  constexpr int N = 400;
  Walls watts{};
  double sum = 0;
  for (int i = 0; i < N * N; ++i)
  {
    const double v = (i / N + 0.5) / N, h = 4. * (i % N + 0.5) / N; // of polar angle, in quarters
    const auto step = static_cast<std::size_t>(h);
    const auto at = [&](std::size_t s) { return (1 - v) * Values[2 * s] + v * Values[2 * s + 1]; };
    const double along = h - static_cast<double>(step);
    const double polar = vtkMath::Pi() / 2 * v, azimuth = vtkMath::Pi() / 2 * h;
    const double weight = ((1 - along) * at(step) + along * at(step + 1)) * std::sin(polar);
    const Vector d = toWorld({ std::sin(polar) * std::cos(azimuth),
      std::sin(polar) * std::sin(azimuth), -std::cos(polar) });
    const auto longest =
      static_cast<std::size_t>(std::max_element(d.begin(), d.end(),
                                 [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        d.begin());
    watts[(2 * longest + 2) % 6 + (d[longest] > 0 ? 1 : 0)] += weight;
    sum += weight;
  }
  for (double& wall : watts)
  {
    wall *= Flux / sum;
  }
  return watts;
}

/// 1 % of all: four standard errors of 20,000 walks are less.
void ExpectWalls(const Walls& found, const Walls& expected, const std::string& name)
{
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 0.01 * Flux) << name << ", wall " << i;
  }
}

Vector Same(const Vector& d)
{
  return d;
}

/// By 90 degrees about z.
Vector Turned(const Vector& d)
{
  return { -d[1], d[0], d[2] };
}

}

TEST(Luminaires, ShineAsTheirTablesSay)
{
  const Walls expected = Expected(Same);
  EXPECT_GT(expected[3], 2 * expected[2]) << "the test tells x from -x";
  EXPECT_GT(expected[4], 1.2 * expected[5]) << "and y from -y";
  int kind = 0;
  for (const Mesh& lamp : MakeLamps(Middle))
  {
    ExpectWalls(FoundBy(MakeBlackRoom({ lamp })), expected, "kind " + std::to_string(kind++));
  }
}

TEST(Luminaires, HaveTheirFlux)
{
  const auto emitted = [](const Mesh& lamp, int band = 0) {
    auto filter = MakeFilter(MakeBlackRoom({ lamp }), 1000);
    ExpectNothing(Update(filter));
    EXPECT_NEAR(
      Field(filter, "AbsorbedPower", band), Field(filter, "EmittedPower", band), 1e-9 * Flux);
    return Field(filter, "EmittedPower", band);
  };
  // The integral of polar / (pi / 2) times sin(polar) up to the horizon is 2 / pi.
  const double horizon = (4 + 1 + 0 + 2) * 2 / vtkMath::Pi(), nadir = 4 * (1 - 2 / vtkMath::Pi());
  for (const Mesh& lamp : MakeLamps(Middle))
  {
    EXPECT_NEAR(emitted(lamp), Flux, 1e-6);
    const Mesh inColour = Copy(lamp), ofTable = Copy(lamp);
    SetFlux(inColour, { 1, 5, 3 });
    EXPECT_NEAR(emitted(inColour), 1, 1e-3);
    EXPECT_NEAR(emitted(inColour, 1), 5, 1e-3);
    EXPECT_NEAR(emitted(inColour, 2), 3, 1e-3);
    ofTable->GetFieldData()->RemoveArray("Flux");
    EXPECT_NEAR(emitted(ofTable), vtkMath::Pi() / 2 * (horizon + nadir), 1e-6);
  }
  EXPECT_NEAR(
    emitted(WithTable(Join({ MakeVertex({ 1, 1, 1 }), MakeVertex(Middle) }))), 2 * Flux, 1e-6);
  const Mesh two = WithTable(Join({ MakeSquare({ 1, 1, 2 }), MakeSquare(Middle) }));
  EXPECT_NEAR(emitted(two), Flux, 1e-6) << "one lamp";
  SetCellValues(two, "LampId", { 7 });
  for (vtkIdType i = 0; i < 4; ++i)
  {
    two->GetCellData()->GetArray("LampId")->SetTuple1(i, -3);
  }
  EXPECT_NEAR(emitted(two), 2 * Flux, 1e-6);
  ExpectOnlyWarning(MakeFilter(MakeBlackRoom({ WithTable(MakeSquare(Middle), { 0 }) }), 100),
    { "the scene has no light" });
}

// These are normals and vectors, which VTK's filter turns.
TEST(Luminaires, TurnWithTheirArrays)
{
  int kind = 0;
  for (const Mesh& lamp : MakeLamps(Middle))
  {
    const std::string name = "kind " + std::to_string(kind++);
    SetCellValues(lamp, "LampAxis", { 0, 0, -1 });
    SetCellValues(lamp, "LampReference", { 1, 0, 0 });
    lamp->GetCellData()->SetActiveNormals("LampAxis");
    lamp->GetCellData()->SetActiveVectors("LampReference");
    vtkNew<vtkTransform> quarter;
    quarter->Translate(2, 2, 2);
    quarter->RotateZ(90);
    quarter->Translate(-2, -2, -2);
    ExpectWalls(FoundBy(MakeBlackRoom({ Transformed(lamp, quarter) })), Expected(Turned), name);
  }
}

TEST(Luminaires, FollowTheirPoses)
{
  int kind = 0;
  for (const Mesh& lamp : MakeLamps({ 0, 0, 0 }))
  {
    const std::string name = "kind " + std::to_string(kind++);
    Scene scene = MakeBlackRoom({});
    scene.Moving.push_back(MakeMoving(lamp, Middle));
    ExpectWalls(FoundBy(scene), Expected(Same), name);
    scene.Moving[0].Pose->RotateZ(90);
    ExpectWalls(FoundBy(scene), Expected(Turned), name + ", turned");
    scene.Moving[0].Pose->Scale(2, -1, 1);
    ExpectWalls(FoundBy(scene), Expected([](const Vector& d) {
      return Turned({ d[0], -d[1], d[2] });
    }),
      name + ", mirrored");
  }
}

// In floats each of many small cells of a tilted disc looks another way.
TEST(Luminaires, MayHaveManyCellsInOnePlane)
{
  vtkNew<vtkDiskSource> disc;
  disc->SetInnerRadius(0);
  disc->SetRadialResolution(40);
  disc->SetCircumferentialResolution(120);
  vtkNew<vtkTransform> tilt;
  tilt->Translate(2, 2, 2);
  tilt->RotateX(210);
  vtkNew<vtkTransformPolyDataFilter> tilted;
  tilted->SetInputConnection(disc->GetOutputPort());
  tilted->SetTransform(tilt);
  tilted->Update();
  const Mesh lamp = WithTable(Copy(tilted->GetOutput()));
  SetCellValues(lamp, "LampAxis", { 0, 0.5, -std::sqrt(0.75) });
  auto filter = MakeFilter(MakeBlackRoom({ lamp }), 1000);
  ExpectNothing(Update(filter));
  EXPECT_NEAR(Field(filter, "EmittedPower"), Flux, 1e-3 * Flux);
}

TEST(Luminaires, UpdateEqualsRebuildWhileTheyMove)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[1] = WithTable(MakeSquare({ 1.5, 1.5, 2.9 }, 0.6), { 10, 20, 30 });
  scene.Fixed.push_back(WithTable(MakeVertex({ 0.5, 2, 2 })));
  scene.Moving.push_back(MakeMoving(WithTable(MakeBox(0.1, 0.2, 0.1)), { 1.5, 1, 2 }));
  auto filter = MakeFilter(scene, 500);
  auto defaults = MakeDefaultFilter(scene, 500);
  vtkTransform* lamp = scene.Moving[2].Pose;
  const std::function<void()> changes[] = { [] {},
    [&] { scene.Moving[0].Pose->Translate(0.1, 0, 0); }, [&] { lamp->RotateX(20); },
    [&] { lamp->Scale(-1, 1, 1); }, [&] { lamp->Translate(0, 0.1, 0); },
    [&] {
      SetFlux(scene.Moving[2].Model, { 3 });
      scene.Moving[2].Model->Modified();
    },
    [&] {
      scene.Fixed[2]->GetFieldData()->GetArray("RadiantIntensity")->SetTuple1(1, 8);
      scene.Fixed[2]->GetFieldData()->GetArray("RadiantIntensity")->Modified();
      scene.Fixed[2]->Modified();
    },
    [&] {
      SetCellValues(scene.Moving[2].Model, "LampReference", { 0, 1, 0 });
      scene.Moving[2].Model->Modified();
    } };
  int step = 0;
  std::vector<double> before;
  for (const auto& change : changes)
  {
    change();
    EXPECT_TRUE(UpdatesLike(filter, MakeFilter(scene, 500))) << "step " << step;
    EXPECT_TRUE(UpdatesLike(defaults, MakeDefaultFilter(scene, 500))) << "step " << step;
    const std::vector<double> now = ValuesOf(IrradianceOf(filter, 0, 0));
    EXPECT_NE(now, before) << "step " << step++;
    before = now;
  }
}

TEST(Luminaires, SayWhatIsWrong)
{
  const auto without = [](const char* name) {
    return [name](vtkPolyData* lamp) { lamp->GetFieldData()->RemoveArray(name); };
  };
  const auto with = [](const char* name, const std::vector<double>& values) {
    return [name, values](vtkPolyData* lamp) { SetField(lamp, name, values); };
  };
  const auto cells = [](const char* name, const std::vector<double>& values) {
    return [name, values](vtkPolyData* lamp) { SetCellValues(lamp, name, values); };
  };
  std::vector<double> negative = Values, dark(10, 0.0);
  negative[4] = -1;
  const struct
  {
    std::function<void(vtkPolyData*)> Spoil;
    std::vector<std::string> Words;
  } wrong[] = {
    { without("PolarAngles"), { "RadiantIntensity", "not PolarAngles" } },
    { without("AzimuthAngles"), { "RadiantIntensity", "not AzimuthAngles" } },
    { with("PolarAngles", { 0, 45, 90 }),
      { "RadiantIntensity", "10 values for 5 azimuths and 3" } },
    { with("PolarAngles", { 0, 190 }), { "RadiantIntensity", "polar angle number 1 is 190" } },
    { with("AzimuthAngles", { 0, 90, 180, 170, 360 }), { "azimuth number 3 is 170" } },
    { with("RadiantIntensity", negative), { "value number 4 is -1" } },
    { with("RadiantIntensity", dark), { "shine 24 W", "RadiantIntensity is 0" } },
    { with("Flux", { -2 }), { "Flux", "-2 W" } },
    { with("Flux", { 1, 2 }), { "Flux", "one tuple of 1 or 3" } },
    { cells("LampAxis", { 0, 0, 0 }), { "cell 0", "LampAxis is not a direction" } },
    { cells("LampReference", { 0, 0.6, 0.8 }), { "cell 0", "LampReference is not across" } },
    { cells("LampAxis", { 1, 0 }), { "cell 0", "LampAxis", "3 components" } },
    { cells("LampAxis", { 0, 0, 1 }), { "cell 0", "% of the light", "behind the opening" } },
    { cells("RadiantExitance", { 1 }), { "table of radiant intensity", "radiant exitance" } },
    { cells("RadiantFlux", { 1 }), { "table of radiant intensity", "radiant flux" } },
  };
  for (const auto& row : wrong)
  {
    const Mesh lamp = WithTable(MakeSquare(Middle));
    row.Spoil(lamp);
    std::vector<std::string> words = row.Words;
    words.emplace_back("onnection 1");
    ExpectOnlyError(MakeFilter(MakeBlackRoom({ lamp }), 100), words);
  }
}
