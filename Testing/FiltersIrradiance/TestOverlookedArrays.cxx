// SPDX-License-Identifier: BSD-3-Clause
// Cell arrays that are nearly called as those that the filter reads.

#include "ErrorObserver.h"
#include "TestScenes.h"

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 500;

void Rename(vtkPolyData* mesh, const char* name, const char* newName)
{
  mesh->GetCellData()->GetArray(name)->SetName(newName);
  mesh->Modified();
}

/// Two lamps, of which the second one's exitance has another name.
vtkSmartPointer<vtkIrradianceFilter> MakeFilterWith(const char* name)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakeLamp({ 0.5, 0.5, 2.875 }, 0.25, { 100 }));
  Rename(scene.Fixed[2], "RadiantExitance", name);
  return MakeFilter(scene, NumberOfWalks);
}

}

TEST(OverlookedArrays, NearlyTheRightNameIsAWarningOnce)
{
  for (const char* name :
    { "Radiant Exitance", "radiantexitance", "radiant_exitance", "RadiantExitance (W/m2)",
      "RadiantExitance[W/m^2]", "RADIANT-EXITANCE", "Emittance", "Exitance" })
  {
    SCOPED_TRACE(name);
    const auto filter = MakeFilterWith(name);
    ExpectOnlyWarning(filter,
      { "input port 0, connection 2", std::string("\"") + name + "\"", "not read",
        "\"RadiantExitance\"", "SetCellArray" });
    filter->GetDynamicTransform(0)->Modified();
    ExpectNothing(Update(filter));
  }
}

TEST(OverlookedArrays, OtherQuantitiesToo)
{
  const std::vector<std::array<const char*, 2>> names{ { "Albedo", "diffuse reflectance" },
    { "Reflectance", "diffuse reflectance" }, { "diffuse reflectance", "diffuse reflectance" },
    { "specular_reflectance", "specular reflectance" } };
  for (const auto& [name, meaning] : names)
  {
    SCOPED_TRACE(name);
    const Scene scene = MakeSmallScene();
    SetCellValues(scene.Moving[1].Model, name, { 0.25 });
    ExpectOnlyWarning(
      MakeFilter(scene, NumberOfWalks), { "input port 1, connection 1", name, meaning });
  }
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakePointLight({ 1.5, 0.5, 1 }, { 10 }));
  Rename(scene.Fixed[2], "RadiantFlux", "Radiant flux (W)");
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "connection 2", "\"RadiantFlux\"" });
}

TEST(OverlookedArrays, NothingIsSaidWithoutCause)
{
  const Scene scene = MakeSmallScene();
  const Mesh room = scene.Fixed[0];
  // Beside the array that is read; of another kind of cell; of another meaning; of a longer name.
  SetCellValues(room, "DiffuseReflectance", { 0.5 });
  SetCellValues(room, "Albedo", { 0.25 });
  SetCellValues(room, "radiant flux", { 1 });
  SetCellValues(room, "Temperature", { 300 });
  SetCellValues(room, "ReflectanceInWinter", { 0.1 });
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));

  // Where somebody has chosen, whether an array or none.
  room->GetCellData()->RemoveArray("DiffuseReflectance");
  for (const char* choice : { "Albedo", "None" })
  {
    const auto filter = MakeFilter(scene, NumberOfWalks);
    filter->SetCellArray("DiffuseReflectance", choice);
    ExpectNothing(Update(filter));
  }
}

TEST(OverlookedArrays, NoLightListsWhatIsNotRead)
{
  Scene scene = MakeSmallScene();
  Rename(scene.Fixed[1], "RadiantExitance", "Glow");
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.5 });
  SetCellValues(scene.Moving[0].Model, "Temperature", { 300 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const Reports reports = Update(filter);
  ExpectOne(reports.Warnings,
    { "no light", "\"RadiantExitance\"", "\"RadiantFlux\"", "connection 1: \"Glow\"",
      "input port 1, connection 0: \"Temperature\"", "SetCellArray" });
  EXPECT_EQ(reports.Warnings[0].find("DiffuseReflectance\""), std::string::npos) << "it is read";

  // In an animation it is said once, and again when something was changed in vain.
  scene.Moving[0].Pose->Translate(0.1, 0, 0);
  ExpectNothing(Update(filter));
  Rename(scene.Fixed[1], "Glow", "Shine");
  ExpectOnlyWarning(filter, { "no light", "\"Shine\"" });
  filter->SetCellArray("RadiantExitance", "Shine");
  ExpectNothing(Update(filter));
}
