// SPDX-License-Identifier: BSD-3-Clause
// Input that cannot be computed: one error that says where, an empty output, a filter that still
// works.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkImageData.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 500;
const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

/// Connections: port 0 has the room, the lamp and a point light, port 1 a ball and a box.
Scene MakeGoodScene()
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.5 });
  scene.Fixed.push_back(MakePointLight({ 1.5, 0.5, 1 }, { 10 }));
  return scene;
}

struct BadInput
{
  std::string Name;
  std::function<void(vtkIrradianceFilter*, Scene&)> Spoil;
  std::vector<std::string> Words; ///< of the error

  friend std::ostream& operator<<(std::ostream& os, const BadInput& bad) { return os << bad.Name; }
};

using Spoil = std::function<void(vtkIrradianceFilter*, Scene&)>;

Spoil MovePoint(std::size_t connection, vtkIdType point, double x)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    scene.Moving[connection].Model->GetPoints()->SetPoint(point, x, 0, 0);
  };
}

Spoil ChangeCell(vtkIdType pointId)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    const vtkIdType ids[4] = { 0, pointId, 1, 2 };
    vtkNew<vtkCellArray> cells;
    cells->DeepCopy(scene.Fixed[0]->GetPolys());
    cells->ReplaceCellAtId(4, 4, ids);
    scene.Fixed[0]->SetPolys(cells);
  };
}

Spoil SetValue(std::size_t connection, const char* name, vtkIdType cell, double value)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    scene.Fixed[connection]->GetCellData()->GetArray(name)->SetComponent(cell, 0, value);
  };
}

Spoil SetPose(int row, int column, double value)
{
  return [=](vtkIrradianceFilter* filter, Scene&) {
    vtkNew<vtkMatrix4x4> matrix;
    matrix->SetElement(row, column, value);
    vtkNew<vtkMatrixToLinearTransform> pose;
    pose->SetInput(matrix);
    filter->SetDynamicTransform(1, pose);
  };
}

Spoil ScalePose(double scale)
{
  return [=](vtkIrradianceFilter* filter, Scene&) {
    vtkNew<vtkTransform> pose;
    pose->Scale(scale, scale, scale);
    filter->SetDynamicTransform(1, pose);
  };
}

Spoil SetObjectToWorld(int numberOfValues, int changed, double value)
{
  return [=](vtkIrradianceFilter* filter, Scene& scene) {
    std::vector<double> values;
    for (int i = 0; i < numberOfValues; ++i)
    {
      values.push_back(i == changed ? value : (i % 5 == 0 ? 1 : 0));
    }
    SetField(scene.Moving[1].Model, "ObjectToWorld", values);
    filter->SetDynamicTransform(1, nullptr);
  };
}

Spoil AddTransform(int connection)
{
  return [=](vtkIrradianceFilter* filter, Scene&) {
    filter->SetDynamicTransform(connection, vtkNew<vtkTransform>());
  };
}

using Filter = vtkIrradianceFilter;

template <class Value>
Spoil Set(void (Filter::*set)(Value), std::common_type_t<Value> value)
{
  return [=](Filter* filter, Scene&) { (filter->*set)(value); };
}

/// Where there is a target of error.
Spoil WithATarget(const Spoil& spoil)
{
  return [=](Filter* filter, Scene& scene) {
    filter->SetTargetRelativeError(0.1);
    spoil(filter, scene);
  };
}

Spoil SetRays(int rays, int mostRays)
{
  return [=](Filter* filter, Scene&) {
    filter->SetNumberOfRays(rays);
    filter->SetMaximumNumberOfGatherRays(mostRays);
  };
}

Spoil SetErrorsOfWalks(vtkIdType walks)
{
  return [=](Filter* filter, Scene&) {
    filter->ComputeStandardErrorOn();
    filter->SetNumberOfWalks(walks);
  };
}

template <class Array>
Spoil ReplaceArray(const char* name, int components, vtkIdType tuples)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      array->SetVariantValue(i, 0.5);
    }
    scene.Fixed[1]->GetCellData()->RemoveArray(name);
    scene.Fixed[1]->GetCellData()->AddArray(array);
  };
}

/// A part of the room's cells reflects specularly.
Spoil SetGloss(const char* name, vtkIdType cell, double value)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    SetCellValues(scene.Fixed[0], "SpecularReflectance", { 0.25 });
    SetCellValues(scene.Fixed[0], "PhongExponent", { 20 });
    scene.Fixed[0]->GetCellData()->GetArray(name)->SetComponent(cell, 0, value);
  };
}

/// All of the room's cells let light through.
Spoil SetSheet(const char* name, vtkIdType cell, double value)
{
  return [=](vtkIrradianceFilter*, Scene& scene) {
    SetCellValues(scene.Fixed[0], "DiffuseTransmittance", { 0.125 });
    SetCellValues(scene.Fixed[0], "SpecularTransmittance", { 0.25 });
    SetCellValues(scene.Fixed[0], "RefractiveIndex", { 1 });
    SetCellValues(scene.Fixed[0], "InternalTransmittance", { 0.9 });
    scene.Fixed[0]->GetCellData()->GetArray(name)->SetComponent(cell, 0, value);
  };
}

const std::string Room = "input port 0, connection 0";
const std::string Lamp = "input port 0, connection 1";
const std::string Bulb = "input port 0, connection 2";
const std::string Ball = "input port 1, connection 0";
const std::string Box = "input port 1, connection 1";

// The cube's point 3 is first used by its cell 0, whose points are 0, 1, 3 and 2.
const std::vector<BadInput> BadInputs{
  { "PointIsNaN", MovePoint(1, 3, NaN), { Box, "cell 0", "point 3", "nan" } },
  { "PointIsInfinite", MovePoint(1, 3, -Infinity), { Box, "cell 0", "point 3", "-inf" } },
  { "PointIsTooFar", MovePoint(1, 3, 1e31), { Box, "cell 0", "point 3", "1e+31" } },
  { "CellPointsPastThePoints", ChangeCell(96), { Room, "cell 4", "point 96 of 96" } },
  { "CellPointsFarPastThePoints", ChangeCell(1LL << 40),
    { Room, "cell 4", "point 1099511627776 of 96" } },
  { "CellHasNegativePoint", ChangeCell(-1), { Room, "cell 4", "point -1 of 96" } },
  { "TooFewTuples", ReplaceArray<vtkDoubleArray>("RadiantExitance", 1, 0),
    { Lamp, "RadiantExitance", "0 tuples for 1 cells" } },
  { "TooManyTuples", ReplaceArray<vtkDoubleArray>("DiffuseReflectance", 1, 7),
    { Lamp, "DiffuseReflectance", "7 tuples for 1 cells" } },
  { "Strings", ReplaceArray<vtkStringArray>("RadiantExitance", 1, 1),
    { Lamp, "RadiantExitance", "vtkStringArray" } },
  { "TwoComponents", ReplaceArray<vtkDoubleArray>("RadiantExitance", 2, 1),
    { Lamp, "RadiantExitance", "2 components" } },
  { "TuplesAndComponentsSwapped", ReplaceArray<vtkDoubleArray>("DiffuseReflectance", 1, 3),
    { Lamp, "DiffuseReflectance", "3 tuples for 1 cells", "NumPy", "(1,) or (1, 3)" } },
  { "OtherLengthSpreadOverAllCells", ReplaceArray<vtkDoubleArray>("DiffuseReflectance", 5, 1),
    { Lamp, "5 components; 1 or 3", "(1,) or (1, 3)", "append() repeats" } },
  { "ReflectanceAbove1", SetValue(0, "DiffuseReflectance", 7, 1.5),
    { Room, "cell 7", "reflectance 1.5" } },
  { "ReflectanceBarelyAbove1", SetValue(0, "DiffuseReflectance", 7, 1 + 1e-9),
    { Room, "cell 7", "reflectance 1.000000001" } },
  { "ReflectanceBelow0", SetValue(0, "DiffuseReflectance", 53, -0.25),
    { Room, "cell 53", "reflectance -0.25" } },
  { "ReflectanceIsNaN", SetValue(0, "DiffuseReflectance", 7, NaN),
    { Room, "cell 7", "reflectance nan" } },
  { "SpecularBelow0", SetGloss("SpecularReflectance", 7, -0.1),
    { Room, "cell 7", "specular reflectance -0.1" } },
  { "SpecularIsNaN", SetGloss("SpecularReflectance", 7, NaN),
    { Room, "cell 7", "specular reflectance nan" } },
  { "DiffuseAndSpecularAbove1", SetGloss("SpecularReflectance", 7, 0.51),
    { Room, "cell 7", "0.5", "0.51", "more than 1" } },
  { "ExponentBelow0", SetGloss("PhongExponent", 7, -1), { Room, "cell 7", "exponent -1" } },
  { "ExponentIsNaN", SetGloss("PhongExponent", 7, NaN), { Room, "cell 7", "exponent nan" } },
  { "TransmittanceAbove1", SetSheet("SpecularTransmittance", 7, 1.5),
    { Room, "cell 7", "specular transmittance 1.5" } },
  { "TransmittanceIsNaN", SetSheet("DiffuseTransmittance", 7, NaN),
    { Room, "cell 7", "diffuse transmittance nan" } },
  { "AllPartsAbove1", SetSheet("SpecularTransmittance", 7, 0.51),
    { Room, "cell 7", "diffuse reflectance 0.5", "diffuse transmittance 0.125", "0.51",
      "more than 1" } },
  { "IndexBelow1", SetSheet("RefractiveIndex", 7, 0.9), { Room, "cell 7", "index 0.9" } },
  { "IndexIsNaN", SetSheet("RefractiveIndex", 7, NaN), { Room, "cell 7", "index nan" } },
  { "InternalTransmittanceIs0", SetSheet("InternalTransmittance", 7, 0),
    { Room, "cell 7", "internal transmittance 0" } },
  { "ExponentHasThreeBands", ReplaceArray<vtkDoubleArray>("PhongExponent", 3, 1),
    { Lamp, "PhongExponent", "3 components; 1 is" } },
  { "ExitanceIsNegative", SetValue(1, "RadiantExitance", 0, -3e-9),
    { Lamp, "cell 0", "exitance -3e-09" } },
  { "ExitanceIsNaN", SetValue(1, "RadiantExitance", 0, NaN), { Lamp, "cell 0", "exitance nan" } },
  { "ExitanceIsInfinite", SetValue(1, "RadiantExitance", 0, Infinity),
    { Lamp, "cell 0", "exitance inf" } },
  { "ExitanceIsHuge", SetValue(1, "RadiantExitance", 0, 1e308),
    { Lamp, "cell 0", "exitance 1e+308" } },
  { "FluxIsNegative", SetValue(2, "RadiantFlux", 0, -4), { Bulb, "cell 0", "flux -4" } },
  { "FluxIsNaN", SetValue(2, "RadiantFlux", 0, NaN), { Bulb, "cell 0", "flux nan" } },
  { "TransformIsSingular", SetPose(1, 1, 0), { Box, "singular", "0 0 1 0" } },
  { "TransformShrinksToNothing", ScalePose(1e-40), { Box, "shrinks", "1e-40" } },
  { "TransformIsNaN", SetPose(0, 3, NaN), { Box, "not finite", "nan" } },
  { "TransformIsInfinite", SetPose(0, 0, Infinity), { Box, "not finite", "inf" } },
  { "TransformReachesTooFar", SetPose(1, 3, 1e200), { Box, "out of range", "1e+200" } },
  { "TransformIsProjective", SetPose(3, 0, 0.5), { Box, "not affine", "0.5" } },
  { "ObjectToWorldIsProjective", SetObjectToWorld(16, 15, 2), { Box, "not affine", "2" } },
  { "ObjectToWorldIsSingular", SetObjectToWorld(16, 5, 0), { Box, "singular" } },
  { "ObjectToWorldIsNaN", SetObjectToWorld(16, 3, NaN), { Box, "not finite", "nan" } },
  { "ObjectToWorldHas15Values", SetObjectToWorld(15, 0, 1), { Box, "ObjectToWorld", "15" } },
  { "TransformOfNoConnection", AddTransform(2), { "connection 2", "port 1 has 2" } },
  { "TransformOfNegativeConnection", AddTransform(-1), { "connection -1", "port 1 has 2" } },
  { "NoWalks", Set(&Filter::SetNumberOfWalks, 0), { "NumberOfWalks is 0" } },
  { "NegativeWalks", Set(&Filter::SetNumberOfWalks, -5), { "NumberOfWalks is -5" } },
  { "TooManyWalks", Set(&Filter::SetNumberOfWalks, 1LL << 32), { "NumberOfWalks is 4294967296" } },
  { "NoReplicates", Set(&Filter::SetNumberOfReplicates, 0), { "NumberOfReplicates is 0" } },
  { "OneReplicate", Set(&Filter::SetNumberOfReplicates, 1), { "NumberOfReplicates is 1;" } },
  { "TooManyReplicates", Set(&Filter::SetNumberOfReplicates, 257),
    { "NumberOfReplicates is 257" } },
  { "NoSpreadPhotons", Set(&Filter::SetNumberOfSpreadPhotons, 0),
    { "NumberOfSpreadPhotons is 0;" } },
  { "TooManySpreadPhotons", Set(&Filter::SetNumberOfSpreadPhotons, 1000001),
    { "NumberOfSpreadPhotons is 1000001;" } },
  { "FewerWalksThanReplicates", SetErrorsOfWalks(15), { "NumberOfWalks", "is 15; 16 to" } },
  { "NegativeTarget", Set(&Filter::SetTargetRelativeError, -0.1),
    { "TargetRelativeError is -0.1" } },
  { "TargetNaN", Set(&Filter::SetTargetRelativeError, NaN), { "TargetRelativeError is nan" } },
  { "InfiniteTarget", Set(&Filter::SetTargetRelativeError, Infinity),
    { "TargetRelativeError is inf" } },
  { "TargetInPercent", Set(&Filter::SetTargetRelativeError, 5),
    { "TargetRelativeError is 5", "5 % is 0.05" } },
  { "TargetWithFewerWalksThanTheFirst", WithATarget(Set(&Filter::SetMaximumNumberOfWalks, 499)),
    { "MaximumNumberOfWalks", "is 499; 500 to" } },
  { "TargetWithTooManyWalks", WithATarget(Set(&Filter::SetMaximumNumberOfWalks, 1LL << 32)),
    { "MaximumNumberOfWalks", "4294967296" } },
  { "TargetWithFewerRaysThanTheFirst", WithATarget(SetRays(64, 63)),
    { "MaximumNumberOfGatherRays", "is 63; 64 to 65536" } },
  { "TargetWithTooManyRays", WithATarget(SetRays(8, 65537)),
    { "MaximumNumberOfGatherRays", "is 65537; 8 to" } },
  { "TargetWithLessEffortThanOne", WithATarget(Set(&Filter::SetMaximumEffort, 0.9)),
    { "MaximumEffort is 0.9" } },
  { "EffortNaN", WithATarget(Set(&Filter::SetMaximumEffort, NaN)), { "MaximumEffort is nan" } },
  { "DefaultReflectanceAbove1", Set(&Filter::SetDefaultDiffuseReflectance, 2),
    { "DefaultDiffuseReflectance is 2;" } },
  { "DefaultReflectanceIsNaN", Set(&Filter::SetDefaultDiffuseReflectance, NaN),
    { "DefaultDiffuseReflectance is nan" } },
  { "EstimateThatIsGone", Set(&Filter::SetCellEstimate, 2),
    { "CellEstimate is 2, which was Nearest", "vtkIrradianceProbeFilter" } },
  { "CellsThatAreGone", Set(&Filter::SetGatherOn, 1),
    { "GatherOn is 1, which was DynamicCells", "Method" } },
  { "NegativeBudget", Set(&Filter::SetRepairTimeBudget, -0.5), { "RepairTimeBudget is -0.5" } },
  { "BudgetIsNaN", Set(&Filter::SetRepairTimeBudget, NaN), { "RepairTimeBudget is nan" } },
};

/// Connects a spoiled scene and updates.
void ExpectError(vtkIrradianceFilter* filter, ErrorObserver* observer, const BadInput& bad)
{
  observer->Clear();
  Scene scene = MakeGoodScene();
  Connect(filter, scene);
  bad.Spoil(filter, scene);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  ExpectOne(observer->Errors, bad.Words);
  EXPECT_EQ(observer->Failures, 1);
}

void ExpectGood(vtkIrradianceFilter* filter, ErrorObserver* observer, const OutputBits& expected)
{
  observer->Clear();
  Connect(filter, MakeGoodScene());
  filter->SetNumberOfWalks(NumberOfWalks);
  filter->SetNumberOfReplicates(16);
  filter->SetNumberOfSpreadPhotons(250);
  filter->SetNumberOfRays(32);
  filter->SetMaximumNumberOfGatherRays(1024);
  filter->SetTargetRelativeError(0);
  filter->SetMaximumEffort(0);
  filter->ComputeStandardErrorOff();
  filter->SetRepairTimeBudget(0);
  filter->SetMethodToWalks();
  filter->SetDefaultDiffuseReflectance(0.5);
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  EXPECT_TRUE(IsSame(OutputBits(filter), expected));
}

class BadInputTest : public testing::TestWithParam<BadInput>
{
};

}

TEST_P(BadInputTest, IsNamedAndForgotten)
{
  const auto fresh = MakeFilter(MakeGoodScene(), NumberOfWalks);
  fresh->Update();
  const OutputBits expected(fresh);
  ASSERT_FALSE(expected.IsEmpty());

  const auto filter = MakeFilter({}, NumberOfWalks);
  const auto observer = ErrorObserver::Watch(filter);
  for (int round = 0; round < 2; ++round) // a new filter, then one with a history
  {
    SCOPED_TRACE("round " + std::to_string(round));
    ExpectError(filter, observer, GetParam());
    ExpectGood(filter, observer, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, BadInputTest, testing::ValuesIn(BadInputs),
  [](const auto& info) { return info.param.Name; });

// An input of another kind is one error, whichever port and however many outputs somebody asks for.
TEST(BadInputKind, IsOneErrorThatSaysHowToMakePolyData)
{
  const std::vector<vtkSmartPointer<vtkDataObject>> others{
    vtkSmartPointer<vtkUnstructuredGrid>::New(), vtkSmartPointer<vtkImageData>::New(),
    vtkSmartPointer<vtkTable>::New()
  };
  for (const auto& other : others)
  {
    for (const int port : { 0, 1 })
    {
      SCOPED_TRACE(std::string(other->GetClassName()) + " on port " + std::to_string(port));
      const auto filter = MakeFilter(MakeGoodScene(), NumberOfWalks);
      filter->AddInputDataObject(port, other);
      ExpectWords(OnlyErrorOf(filter),
        { "input port " + std::to_string(port), "connection " + std::to_string(port == 0 ? 3 : 2),
          other->GetClassName(), "vtkPolyData", "vtkGeometryFilter", "Extract Surface" });
    }
  }
}

TEST(BadInputKind, IsOneErrorOfTheOtherFiltersToo)
{
  const auto irradiance = MakeFilter(MakeGoodScene(), NumberOfWalks);
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetEstimateToNearest();
  probe->SetInputData(image);
  probe->SetSourceConnection(irradiance->GetOutputPort());
  ExpectOne(Update(probe).Errors, { "the sensors have no point normals" });
  EXPECT_EQ(probe->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  vtkNew<vtkPointIrradianceFilter> points;
  for (vtkDataObject* other : std::initializer_list<vtkDataObject*>{ mesh, image })
  {
    probe->SetInputData(mesh);
    probe->SetSourceData(other);
    ExpectOne(Update(probe).Errors, { "the source is no output of vtkIrradianceFilter" });
    for (vtkAlgorithm* view : std::initializer_list<vtkAlgorithm*>{ radiance, points })
    {
      view->SetInputDataObject(other);
      ExpectOne(Update(view).Errors, { "the input is no output of vtkIrradianceFilter" });
    }
  }
}

// What was read before the error must not outlive its connection.
TEST(BadInputGoes, AndTheStaticInputWithIt)
{
  Scene scene = MakeGoodScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  scene.Fixed[0]->GetPoints()->SetPoint(0, NaN, 0, 0);
  scene.Fixed[0]->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(observer->Errors.size(), 1u);

  scene.Fixed.clear();
  SetCellValues(scene.Moving[0].Model, "RadiantExitance", { 10 });
  Connect(filter, scene);
  EXPECT_TRUE(UpdatesLike(filter, MakeFilter(scene, NumberOfWalks)));
}
