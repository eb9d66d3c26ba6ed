// SPDX-License-Identifier: BSD-3-Clause
// Poses from field data that change with time: ObjectToWorld, and the poses in glTF files.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkGLTFReader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>

using namespace TestScenes;

namespace
{

constexpr vtkIdType Walks = 2000;

/**
 * A tetrahedron in a .gltf file and its .bin. A node that turns by 90 degrees about z and stands at
 * (1.5, 1.5, 1) holds a node that moves from x = -1 at time 0 to x = 1 at time 4: so in the world
 * from y = 0.5 to y = 2.5. Returns the path.
 */
std::string WriteTetrahedron(int primitives)
{
  const float points[] = { 0, 0, 0, 0.5F, 0, 0, 0, 0.5F, 0, 0, 0, 0.5F };
  const float times[] = { 0, 4 }, positions[] = { -1, 0, 0, 1, 0, 0 };
  const std::uint16_t corners[] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
  const std::string path = testing::TempDir() + "Tetrahedron.gltf";
  std::ofstream data(testing::TempDir() + "Tetrahedron.bin", std::ios::binary);
  data.write(reinterpret_cast<const char*>(points), sizeof(points));       // at 0, 48 bytes
  data.write(reinterpret_cast<const char*>(times), sizeof(times));         // at 48, 8
  data.write(reinterpret_cast<const char*>(positions), sizeof(positions)); // at 56, 24
  data.write(reinterpret_cast<const char*>(corners), sizeof(corners));     // at 80, 24
  const std::string primitive = R"({"attributes": {"POSITION": 0}, "indices": 3})";
  std::ofstream(path) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1.5, 1.5, 1, 1], "children": [1]},
      {"mesh": 0, "translation": [-1, 0, 0]}],
    "meshes": [{"primitives": [)"
                      << primitive << (primitives > 1 ? ", " + primitive : "") << R"(]}],
    "animations": [{"samplers": [{"input": 1, "output": 2}],
      "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
    "buffers": [{"uri": "Tetrahedron.bin", "byteLength": 104}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 8},
      {"buffer": 0, "byteOffset": 56, "byteLength": 24},
      {"buffer": 0, "byteOffset": 80, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
        "min": [0, 0, 0], "max": [0.5, 0.5, 0.5]},
      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [4]},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 3, "componentType": 5123, "count": 12, "type": "SCALAR"}]})";
  return path;
}

vtkSmartPointer<vtkGLTFReader> MakeReader(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkGLTFReader>::New();
  reader->SetFileName(path.c_str());
  reader->ApplyDeformationsToGeometryOff();
  reader->SetFrameRate(1);
  reader->UpdateInformation();
  reader->EnableAnimation(0);
  return reader;
}

Scene MakeStill()
{
  return { MakeSmallScene().Fixed, {} };
}

}

// The node's matrix, which the reader writes into the field data, row by row, and VTK's own reader
// of time: each time in any order has the bits of a new filter with a transform.
TEST(FieldPoses, OfGltfFilesMoveParts)
{
  auto filter = MakeFilter(MakeStill(), Walks);
  const auto reader = MakeReader(WriteTetrahedron(1));
  filter->AddInputConnection(1, reader->GetOutputPort());
  filter->SetPoseArrayName("globalTransform");
  std::map<double, OutputBits> first;
  for (const double time : { 0., 3., 1., 3., 0., 2., 4., 1. })
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, first.empty());
    const auto known = first.emplace(time, OutputBits(filter)).first;
    EXPECT_TRUE(IsSame(OutputBits(filter), known->second)) << "time " << time;

    vtkNew<vtkMultiBlockDataSet> model;
    model->DeepCopy(reader->GetOutput());
    vtkNew<vtkTransform> pose;
    const double matrix[16] = { 0, -1, 0, 1.5, 1, 0, 0, 0.5 + time / 2, 0, 0, 1, 1, 0, 0, 0, 1 };
    pose->SetMatrix(matrix);
    auto fresh = MakeFilter(MakeStill(), Walks);
    fresh->AddInputDataObject(1, model);
    fresh->SetDynamicTransform(0, pose);
    fresh->Update();
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << "time " << time;
  }
  EXPECT_EQ(first.size(), 5u);
}

// VTK's reader writes the matrix for the first primitive alone.
TEST(FieldPoses, AreNeededByAllLeavesOfAConnection)
{
  auto filter = MakeFilter(MakeStill(), Walks);
  filter->AddInputConnection(1, MakeReader(WriteTetrahedron(2))->GetOutputPort());
  filter->SetPoseArrayName("globalTransform");
  ExpectWords(OnlyErrorOf(filter),
    { "has no field array globalTransform", "input port 1, connection 0, block" });
}

// World = transform or ObjectToWorld, after the named one. None is passed on.
TEST(FieldPoses, ByNameComeBeforeTheOthers)
{
  const Mesh box = MakeBox(0.4, 0.5, 0.6);
  SetField(box, "own", { 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  SetField(box, "ObjectToWorld", { 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1 });
  auto filter = MakeFilter(MakeStill(), Walks);
  filter->AddInputDataObject(1, box);
  filter->SetPoseArrayName("own");
  const auto expect = [&](double x) {
    Scene scene = MakeStill();
    scene.Moving.push_back(MakeMoving(MakeBox(0.4, 0.5, 0.6), { x, 1, 1 }));
    const double matrix[16] = { 0, -1, 0, x, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1 };
    scene.Moving[0].Pose->SetMatrix(matrix);
    EXPECT_TRUE(UpdatesLike(filter, MakeFilter(scene, Walks))) << x;
    EXPECT_EQ(OutputOf(filter->GetOutput(), 1, 0)->GetFieldData()->GetNumberOfArrays(), 0);
  };
  expect(1);
  vtkNew<vtkTransform> pose;
  pose->Translate(2, 1, 1);
  filter->SetDynamicTransform(0, pose);
  expect(2);
  SetField(box, "own", { 1, 2, 3 });
  ExpectWords(OnlyErrorOf(filter), { "the field array own has 3 values, not 16" });
}

TEST(FieldPoses, WithNaNAreRefused)
{
  const Mesh box = MakeBox(0.4, 0.5, 0.6);
  const double nan = std::nan("");
  SetField(box, "ObjectToWorld", { 1, 0, 0, nan, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1 });
  auto filter = MakeFilter(MakeStill(), Walks);
  filter->AddInputDataObject(1, box);
  ExpectWords(OnlyErrorOf(filter), { "is not finite" });
}
