// SPDX-License-Identifier: BSD-3-Clause
// The oven's parts, its dose and what it writes, against what is known of them beforehand.
#include "../../Testing/MessageOf.h"
#include "../../Testing/WriteFile.h"
#include "CureTable.h"
#include "Oven.h"
#include "OvenOptions.h"
#include "ProductionLine.h"
#include "RideLog.h"

#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkCompositeDataSet.h>
#include <vtkCubeSource.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRadiantExposureFilter.h>
#include <vtkSTLWriter.h>
#include <vtkSphereSource.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

using namespace curingoven;

namespace
{

bool Has(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

std::string TextOf(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

template <typename Writer, typename Source>
std::string WriteMesh(const std::string& name)
{
  std::string path = testing::TempDir() + name;
  vtkNew<Source> source;
  vtkNew<Writer> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
  return path;
}

std::string Cube()
{
  return WriteMesh<vtkSTLWriter, vtkCubeSource>("cube.stl");
}

std::string Ball()
{
  return WriteMesh<vtkPLYWriter, vtkSphereSource>("ball.ply");
}

double AreaOf(vtkPolyData* mesh)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(mesh);
  sizes->ComputeSumOn();
  sizes->Update();
  return sizes->GetPolyDataOutput()->GetFieldData()->GetArray("Area")->GetTuple1(0);
}

int CountOpenEdges(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOn();
  edges->Update();
  return int(edges->GetOutput()->GetNumberOfCells());
}

vtkDataArray* DoseOf(vtkPolyData* part)
{
  return part->GetCellData()->GetArray("RadiantExposure");
}

std::vector<std::string> SmallLine()
{
  return { "--part", Cube(), "--part", Ball(), "--cells", "100", "--walks", "20000", "--steps", "9",
    "--lamps", "2" };
}

vtkSmartPointer<vtkMultiBlockDataSet> DoseScene(vtkIrradianceFilter* light, int steps)
{
  vtkNew<vtkRadiantExposureFilter> dose;
  dose->SetInputConnection(light->GetOutputPort());
  dose->SetIntegrationModeToUniform();
  dose->SetNumberOfTimeSteps(steps - 1);
  dose->Update();
  return vtkMultiBlockDataSet::SafeDownCast(dose->GetOutputDataObject(0));
}

}

TEST(OvenOptions, NamesTheOptionThatIsWrong)
{
  const auto read = [](const std::vector<std::string>& words) {
    return MessageOf([&] { ReadOptions(words); });
  };
  EXPECT_EQ(read({}), "nothing thrown");
  EXPECT_PRED2(Has, read({ "--lamps", "0" }), "--lamps: an oven without lamps");
  EXPECT_PRED2(Has, read({ "--lamps", "99" }), "--lamps: 99 do not fit into the tunnel");
  EXPECT_PRED2(Has, read({ "--lamp-pitch", "0.1" }), "--lamps: 4 do not fit side by side");
  EXPECT_PRED2(Has, read({ "--lamp-at", "1.49" }), "--lamp-at: they do not fit into the tunnel");
  EXPECT_PRED2(Has, read({ "--lamp-at=0", "--lamp-at=0.1" }), "--lamp-at: they do not fit side by");
  EXPECT_PRED2(Has, read({ "--lamp-at", "left" }), "--lamp-at: a place from -100 to 100 m");
  EXPECT_PRED2(Has, read({ "--lamp-height", "0.48" }), "below the ceiling");
  EXPECT_PRED2(Has, read({ "--lamp-height", "0.28" }), "where parts ride");
  EXPECT_PRED2(Has, read({ "--opening", "0.6" }), "--opening is higher than the tunnel");
  EXPECT_PRED2(Has, read({ "--oven", "3x0.8" }), "--oven: three lengths");
  EXPECT_PRED2(Has, read({ "--oven", "3x0.8x0.5m" }), "--oven: three lengths");
  EXPECT_PRED2(Has, read({ "--oven", "nanx0.8x0.5" }), "--oven: three lengths");
  EXPECT_PRED2(Has, read({ "--lamp-power", "0" }), "--lamp-power: a number above 0");
  EXPECT_PRED2(Has, read({ "--speed", "0" }), "--speed: a number above 0, in m/s");
  EXPECT_PRED2(Has, read({ "--speed", "-1" }), "--speed");
  EXPECT_PRED2(Has, read({ "--speed", "nan" }), "--speed");
  EXPECT_PRED2(Has, read({ "--speed" }), "--speed: its value is missing");
  EXPECT_PRED2(Has, read({ "--least-dose", "9e3", "--most-dose", "3e3" }),
    "--least-dose and --most-dose are the wrong way round");
  EXPECT_PRED2(Has, read({ "--least-dose", "3e3", "--most-dose", "3e3" }), "wrong way round");
  EXPECT_PRED2(Has, read({ "--steps", "1" }), "--steps: a whole number, at least 2");
  EXPECT_PRED2(Has, read({ "--walks", "0" }), "--walks");
  EXPECT_PRED2(Has, read({ "--steps", "3", "--compare", "4" }), "--compare: there are not so many");
  EXPECT_PRED2(Has, read({ "--spread-dose", "1000001" }), "--spread-dose: at most 1000000");
  EXPECT_PRED2(Has, read({ "--accuracy", "0.1", "--most-walks", "9" }), "--most-walks is below");
  EXPECT_PRED2(Has, read({ "--limits", "9" }), "--limits: there is no such option");
}

TEST(OvenParts, NamesTheFileThatIsWrong)
{
  const auto read = [](const std::vector<std::string>& words) {
    return MessageOf([&] { ReadParts(ReadOptions(words)); });
  };
  EXPECT_PRED2(
    Has, read({ "--part", "/nowhere/gear.stl" }), "--part: /nowhere/gear.stl: there is no such");
  EXPECT_PRED2(Has, read({ "--part", WriteFile("gear.step", "ISO") }), "unknown kind of file");
  EXPECT_PRED2(Has, read({ "--part", WriteFile("no.off", "OFF\n1 0 0\n0 0 0\n") }), "no polygon");
  EXPECT_PRED2(Has,
    read({ "--part", WriteFile("point.off", "OFF\n3 1 0\n1 2 3\n1 2 3\n1 2 3\n3 0 1 2\n") }),
    "point.off: all points are in one place");
  EXPECT_PRED2(Has,
    read({ "--part", WriteFile("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 0 0\n3 0 1 2\n") }),
    "line.off: no cell has an area");
  EXPECT_PRED2(Has, read({ "--part", WriteFile("torn.off", "OFF\n3 1 0\n0 0 0\n") }),
    "torn.off, line 3: the file ends too early");
  EXPECT_PRED2(Has, read({ "--part", WriteFile("torn.ply", "ply\nformat") }), "--part: ");
  EXPECT_PRED2(
    Has, read({ "--part", Cube(), "--part", Cube() }), "--part: two parts have the name \"cube\"");
  EXPECT_PRED2(Has, read({ "--part", Cube(), "--part-size", "0.4" }), "0.4 x 0.4 x 0.4 m is too");
  EXPECT_PRED2(Has, read({ "--part", Cube(), "--unit", "1" }), "1 x 1 x 1 m is too large");
  EXPECT_EQ(read({ "--part", Cube(), "--part=other=" + Cube(), "--cells=9" }), "nothing thrown");
}

TEST(OvenParts, AreCutIntoCellsAndStayClosed)
{
  const std::vector<Part> parts = ReadParts(
    ReadOptions({ "--part", Cube(), "--part", Ball(), "--cells", "1000", "--part-size", "0.1" }));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].Name, "cube");
  for (const Part& part : parts)
  {
    EXPECT_GE(part.Mesh->GetNumberOfCells(), 1000) << part.Name;
    EXPECT_LE(part.Mesh->GetNumberOfCells(), 4000) << part.Name;
    EXPECT_EQ(CountOpenEdges(part.Mesh), 0) << part.Name;
    double b[6];
    part.Mesh->GetBounds(b);
    EXPECT_NEAR(b[5] - b[4], 0.1, 1e-6) << part.Name;
    EXPECT_NEAR(b[4], Lift, 1e-6) << part.Name;
    EXPECT_NEAR(b[0] + b[1], 0, 1e-6) << part.Name;
  }
  EXPECT_NEAR(AreaOf(parts[0].Mesh), 0.06, 1e-6);
  const auto millimetres = ReadParts(ReadOptions({ "--part", Cube(), "--unit", "0.05" }));
  EXPECT_NEAR(AreaOf(millimetres[0].Mesh), 6 * 0.05 * 0.05, 1e-6);
}

TEST(Oven, LampsEmitTheirPowerBelowReflectorsInTheTunnel)
{
  const OvenOptions options = ReadOptions({ "--lamps", "3", "--lamp-power", "700" });
  const auto oven = MakeOven(options);
  ASSERT_EQ(int(oven.size()), NumberOfOvenMeshes);
  vtkNew<vtkIrradianceFilter> light;
  for (vtkPolyData* mesh : oven)
  {
    light->AddInputDataObject(0, mesh);
  }
  light->SetNumberOfWalks(1000);
  light->Update();
  EXPECT_NEAR(
    light->GetOutput()->GetFieldData()->GetArray("EmittedPower")->GetTuple1(0), 2100, 1e-3);
  double lamps[6], reflectors[6];
  oven[Lamps]->GetBounds(lamps);
  oven[Reflectors]->GetBounds(reflectors);
  EXPECT_LT(lamps[5], reflectors[5]);
  EXPECT_LT(reflectors[5], options.OvenHeight);
  EXPECT_GT(lamps[4], options.Opening);
  EXPECT_NEAR(lamps[0] + lamps[1], 0, 1e-6);
}

TEST(Oven, HasTheSizeAndTheLampsThatAreAskedFor)
{
  const auto oven = MakeOven(ReadOptions({ "--oven", "5x1.2x0.8", "--opening", "0.4", "--lamp-at",
    "-1.5", "--lamp-at=2", "--lamp-height", "0.7", "--lamp-power", "50" }));
  double b[6];
  const auto expect = [&](const std::array<double, 6>& expected) {
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(b[i], expected[i], 1e-6) << i;
    }
  };
  oven[Tunnel]->GetBounds(b);
  expect({ -2.5, 2.5, -0.6, 0.6, 0, 0.8 });
  oven[Belt]->GetBounds(b);
  expect({ -3, 3, -0.6, 0.6, 0, 0 });
  oven[Lamps]->GetBounds(b);
  expect({ -1.5 - LampRadius, 2 + LampRadius, -0.5, 0.5, 0.7 - LampRadius, 0.7 + LampRadius });
  // An opening is where the wall above it ends: at x = -2.5 no point lies between belt and 0.4.
  for (vtkIdType i = 0; i < oven[Tunnel]->GetNumberOfPoints(); ++i)
  {
    const double* x = oven[Tunnel]->GetPoint(i);
    const bool isInOpening = x[0] < -2.5 + 1e-6 && std::abs(x[1]) < 0.6 - 1e-6 && x[2] < 0.4 - 1e-6;
    EXPECT_FALSE(isInOpening) << x[1] << " " << x[2];
  }
}

// Of a parabola: a ray from the focus goes straight down.
TEST(Oven, ReflectorsAreParabolasAroundTheLamp)
{
  const auto oven = MakeOven(ReadOptions({ "--lamps", "1" }));
  double lamp[6];
  oven[Lamps]->GetBounds(lamp);
  const double focus = (lamp[4] + lamp[5]) / 2;
  double vertex[6];
  oven[Reflectors]->GetBounds(vertex);
  const double directrix = vertex[5] + (vertex[5] - focus);
  for (vtkIdType i = 0; i < oven[Reflectors]->GetNumberOfPoints(); ++i)
  {
    double x[3];
    oven[Reflectors]->GetPoint(i, x);
    EXPECT_NEAR(std::hypot(x[0], x[2] - focus), directrix - x[2], 1e-6);
  }
}

// The dose by updates, over all of the ride, is the trapezoidal sum of fresh starts, bit for bit.
TEST(OvenDose, IsTheSumOfFreshStarts)
{
  const OvenOptions options = ReadOptions(SmallLine());
  const std::vector<Part> parts = ReadParts(options);
  const auto light = MakeLight(options, parts, options.Walks);
  const RideLog log(options, parts, light, [](int, double) {});
  const auto scene = DoseScene(light, options.Steps);
  log.ThrowIfWrong();
  ASSERT_EQ(int(log.GetSteps().size()), options.Steps);

  std::vector<std::vector<double>> sums(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    sums[i].resize(parts[i].Mesh->GetNumberOfCells());
  }
  const int last = options.Steps - 1;
  const auto timeOf = [&](int step) { return log.GetSteps()[std::clamp(step, 0, last)].Time; };
  EXPECT_EQ(timeOf(0), 0);
  EXPECT_EQ(timeOf(last), ExitTime(options, int(parts.size()) - 1));
  int absent = 0;
  for (int step = 0; step <= last; ++step)
  {
    EXPECT_NEAR(timeOf(step), step * timeOf(last) / last, 1e-12);
    const auto fresh = MakeLight(options, parts, options.Walks);
    fresh->UpdateInformation();
    fresh->UpdateTimeStep(timeOf(step));
    vtkFieldData* field = fresh->GetOutput()->GetFieldData();
    EXPECT_EQ(field->GetArray("EmittedPower")->GetTuple1(0),
      field->GetArray("AbsorbedPower")->GetTuple1(0) +
        field->GetArray("EscapedPower")->GetTuple1(0));
    EXPECT_EQ(field->GetArray("EmittedPower")->GetTuple1(0), log.GetSteps()[step].Emitted);
    const std::vector<vtkPolyData*> lit = PartsOf(fresh->GetOutput());
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      absent += lit[i]->GetNumberOfCells() == 0;
      for (vtkIdType cell = 0; cell < lit[i]->GetNumberOfCells(); ++cell)
      {
        sums[i][cell] += (timeOf(step + 1) - timeOf(step - 1)) / 2 *
          lit[i]->GetCellData()->GetArray("Irradiance")->GetTuple1(cell);
      }
    }
  }
  EXPECT_GT(absent, 0); // parts come and go
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    double total = 0;
    for (std::size_t cell = 0; cell < sums[i].size(); ++cell)
    {
      EXPECT_EQ(DoseOf(PartsOf(scene)[i])->GetTuple1(cell), sums[i][cell])
        << parts[i].Name << " " << cell;
      total += sums[i][cell];
    }
    EXPECT_GT(total, 0);
  }
}

TEST(OvenParts, ThoseOfTheDataAreClosedAndOfSomeTenThousandCells)
{
  if (!std::ifstream(MOVINGTEAPOT_DATA "/downloaded/joint.off"))
  {
    GTEST_SKIP() << "Data/fetch.sh gets them";
  }
  const std::vector<Part> parts = ReadParts(ReadOptions({}));
  EXPECT_EQ(parts.size(), 5u);
  for (const Part& part : parts)
  {
    EXPECT_GE(part.Mesh->GetNumberOfCells(), 10000) << part.Name;
    EXPECT_LE(part.Mesh->GetNumberOfCells(), 20000) << part.Name;
    EXPECT_EQ(CountOpenEdges(part.Mesh), 0) << part.Name;
  }
}

// Twice the speed, half the dose: the same poses at other times.
TEST(OvenDose, FallsWithTheSpeed)
{
  std::vector<std::string> words = SmallLine();
  words.insert(words.end(), { "--speed", "0.25" });
  const OvenOptions slow = ReadOptions(words);
  words.back() = "0.5";
  const OvenOptions fast = ReadOptions(words);
  const std::vector<Part> parts = ReadParts(slow);
  const auto slowScene = DoseScene(MakeLight(slow, parts, slow.Walks), slow.Steps);
  const auto fastScene = DoseScene(MakeLight(fast, parts, fast.Walks), fast.Steps);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    vtkDataArray* dose = DoseOf(PartsOf(slowScene)[i]);
    for (vtkIdType cell = 0; cell < dose->GetNumberOfTuples(); ++cell)
    {
      EXPECT_EQ(dose->GetTuple1(cell), 2 * DoseOf(PartsOf(fastScene)[i])->GetTuple1(cell));
    }
  }
}

// Three squares of 1 m2 with doses and errors that are known.
TEST(CureTable, JudgesCellsByTheLimitsAndTheirErrors)
{
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  mesh->ShallowCopy(cube->GetOutput());
  vtkNew<vtkDoubleArray> dose, error;
  dose->SetName("RadiantExposure");
  error->SetName("RadiantExposureStandardError");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double values[6][2] = { { 100, 10 }, { 990, 10 }, { 1500, 10 }, { 2500, 10 }, { 2500, 400 },
    { 1500, nan } };
  for (const auto& value : values)
  {
    dose->InsertNextValue(value[0]);
    error->InsertNextValue(value[1]);
  }
  mesh->GetCellData()->AddArray(dose);
  mesh->GetCellData()->AddArray(error);
  vtkNew<vtkMultiBlockDataSet> scene, dynamic;
  dynamic->SetBlock(0, mesh);
  scene->SetBlock(1, dynamic);
  vtkNew<vtkDoubleArray> factor;
  factor->SetName("ConfidenceFactor");
  factor->InsertNextValue(2);
  scene->GetFieldData()->AddArray(factor);

  OvenOptions options = ReadOptions({ "--least-dose", "1000", "--most-dose", "2000" });
  const std::vector<Cure> rows = Judge(scene, { { "cube", mesh } }, options);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].Name, "all");
  for (const Cure& row : rows)
  {
    EXPECT_NEAR(row.Area, 6, 1e-6);
    EXPECT_NEAR(row.MeanDose, (100 + 990 + 1500 + 2500 + 2500 + 1500) / 6.0, 1e-6);
    EXPECT_EQ(row.LeastDose, 100);
    EXPECT_EQ(row.MostDose, 2500);
    EXPECT_NEAR(row.UnderArea, 2, 1e-6);
    EXPECT_NEAR(row.OverArea, 2, 1e-6);
    EXPECT_NEAR(row.OpenArea, 3, 1e-6); // 990 +- 20, 2500 +- 800, 1500 +- unknown
  }
  vtkCellData* cells = mesh->GetCellData();
  EXPECT_EQ(cells->GetArray("Cure")->GetTuple1(0), -1);
  EXPECT_EQ(cells->GetArray("Cure")->GetTuple1(2), 0);
  EXPECT_EQ(cells->GetArray("Cure")->GetTuple1(3), 1);
  EXPECT_EQ(cells->GetArray("HalfWidth")->GetTuple1(4), 800);
  // One cell of six, more than 5 % of the area, is not known at all.
  EXPECT_TRUE(std::isinf(ReachedAccuracy(scene, options)));
  error->SetValue(5, 15);
  Judge(scene, { { "cube", mesh } }, options);
  EXPECT_DOUBLE_EQ(ReachedAccuracy(scene, options), 800 / 2500.0);
  error->SetValue(4, 15); // then 100 +- 20 is the worst: it counts by the least dose
  Judge(scene, { { "cube", mesh } }, options);
  EXPECT_DOUBLE_EQ(ReachedAccuracy(scene, options), 20 / 1000.0);
}

namespace
{

struct Ran
{
  int Status;
  std::string Out;
};

Ran RunProgram(const std::string& arguments, const std::string& within = "")
{
  const std::string log = testing::TempDir() + "CuringOven.log";
  const int status =
    std::system((within + "'" + CURING_OVEN + "' " + arguments + " >'" + log + "' 2>&1").c_str());
  return { status, TextOf(log) };
}

// Pixels above the legend, by what the colours of doses say: blue, green to yellow, orange to red.
std::array<int, 3> CountPixels(const std::string& file)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  std::array<int, 3> counts = { 0, 0, 0 };
  for (vtkIdType i = pixels->GetNumberOfTuples() / 5; i < pixels->GetNumberOfTuples(); ++i)
  {
    const double* p = pixels->GetTuple3(i);
    counts[0] += p[2] > p[0] + 60;
    counts[1] += p[1] > p[2] + 30 && p[1] > 0.9 * p[0];
    counts[2] += p[0] > p[1] + 60 && p[0] > p[2] + 60;
  }
  return counts;
}

}

TEST(CuringOvenProgram, WritesPicturesTablesAndTheSceneWithTheSameNumbers)
{
  const std::string folder = testing::TempDir() + "CuringOven-output";
  // What an earlier run left goes, all else stays.
  std::filesystem::create_directories(folder + "/CuringOven");
  WriteFile("CuringOven-output/CuringOven/CuringOven_77.vtp", "old");
  WriteFile("CuringOven-output/CuringOven/mine.vtp", "mine");
  WriteFile("CuringOven-output/Notes.csv", "mine");
  const Ran ran = RunProgram("--part '" + Cube() + "' --part '" + Ball() +
    "' --cells 200 --walks 20000 --steps 8 --compare 3 --size 640x320 --output '" + folder + "'");
  ASSERT_EQ(ran.Status, 0) << ran.Out;
  EXPECT_FALSE(std::filesystem::exists(folder + "/CuringOven/CuringOven_77.vtp"));
  EXPECT_EQ(TextOf(folder + "/CuringOven/mine.vtp"), "mine");
  EXPECT_EQ(TextOf(folder + "/Notes.csv"), "mine");
  EXPECT_PRED2(Has, TextOf(folder + "/ParaViewState.py"), "CuringOven.vtm");
  EXPECT_PRED2(Has, ran.Out, "3 steps were compared with fresh starts");
  EXPECT_PRED2(Has, ran.Out, "With 20000 walks ");
  // Some of the parts is under-cured, some well, some over-cured.
  for (const int count : CountPixels(folder + "/Parts.png"))
  {
    EXPECT_GT(count, 100);
  }
  EXPECT_GT(CountPixels(folder + "/CuringOven.png")[0], 1000); // lit walls are violet
  EXPECT_GT(TextOf(folder + "/CuringOven.ogv").size(), 1000u);

  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder + "/CuringOven.vtm").c_str());
  reader->Update();
  const auto parts = PartsOf(vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput()));
  ASSERT_EQ(parts.size(), 2u);
  auto* scene = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  const auto nameOf = [&](unsigned int group, unsigned int block) {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(scene->GetBlock(group));
    return std::string(blocks->GetMetaData(block)->Get(vtkCompositeDataSet::NAME()));
  };
  EXPECT_EQ(nameOf(0, Lamps), "lamps");
  EXPECT_EQ(nameOf(0, Tunnel), "tunnel");
  EXPECT_EQ(nameOf(1, 0), "cube");
  EXPECT_EQ(nameOf(1, 1), "ball");
  // Side by side on the belt.
  EXPECT_NEAR(parts[0]->GetCenter()[0], Spacing / 2, 1e-6);
  EXPECT_NEAR(parts[1]->GetCenter()[0], -Spacing / 2, 1e-6);
  std::istringstream cells(TextOf(folder + "/Cells.csv"));
  std::string line;
  std::getline(cells, line);
  EXPECT_EQ(line, "part,cell,x_m,y_m,z_m,area_m2,dose_J_m2,half_width_J_m2,cure");
  for (std::size_t part = 0; part < 2; ++part)
  {
    for (vtkIdType i = 0; i < parts[part]->GetNumberOfCells(); ++i)
    {
      ASSERT_TRUE(std::getline(cells, line));
      std::vector<std::string> words;
      std::istringstream row(line);
      for (std::string word; std::getline(row, word, ',');)
      {
        words.push_back(word);
      }
      ASSERT_EQ(words.size(), 9u) << line;
      EXPECT_EQ(words[0], part == 0 ? "cube" : "ball");
      EXPECT_EQ(words[1], std::to_string(i));
      EXPECT_EQ(std::stod(words[6]), DoseOf(parts[part])->GetTuple1(i));
    }
  }
  EXPECT_FALSE(std::getline(cells, line));
  const std::string steps = TextOf(folder + "/Steps.csv");
  EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 1 + 8);
  const std::string table = TextOf(folder + "/Parts.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3);
}

TEST(CuringOvenProgram, NeedsNoDisplay)
{
  const std::string folder = testing::TempDir() + "CuringOven-bare";
  const Ran ran = RunProgram("--part '" + Ball() +
      "' --cells 20 --steps 2 --walks 2000 --spread-dose 50 --output '" + folder + "'",
    "env -u DISPLAY ");
  EXPECT_EQ(ran.Status, 0) << ran.Out;
  EXPECT_PRED2(Has, ran.Out, "No pictures: DISPLAY is not set");
  EXPECT_TRUE(std::filesystem::exists(folder + "/CuringOven.vtm"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/CuringOven.png"));
}

TEST(CuringOvenProgram, ShootsMoreWalksUntilTheAccuracyIsReached)
{
  const std::string arguments = "--part '" + Ball() +
    "' --cells 20 --steps 8 --no-pictures --accuracy 0.2 --walks 20000 --output '" +
    testing::TempDir() + "CuringOven-accuracy' ";
  const Ran ran = RunProgram(arguments);
  EXPECT_EQ(ran.Status, 0) << ran.Out;
  const std::size_t last = ran.Out.rfind("is known within +-");
  ASSERT_NE(last, std::string::npos) << ran.Out;
  EXPECT_NE(ran.Out.rfind("With "), ran.Out.find("With ")) << "one ride was enough: " << ran.Out;
  EXPECT_FALSE(Has(ran.Out, "With 16000000 walks")) << "far more than it takes";
  EXPECT_LE(std::stod(ran.Out.substr(last + 18)), 20.0);
}

TEST(CuringOvenProgram, EndsWithOneErrorThatNamesTheOption)
{
  const std::string output = "--no-pictures --output /dev/null/x --part '" + Ball() + "'";
  for (const auto& [arguments, message] :
    { std::pair{ std::string("--speed 0"), "CuringOven: --speed: " },
      std::pair{ std::string("--part /nowhere.stl"), "CuringOven: --part: /nowhere.stl" },
      std::pair{ output, "CuringOven: --output: /dev/null/x" } })
  {
    const Ran ran = RunProgram(arguments);
    EXPECT_NE(ran.Status, 0) << arguments;
    EXPECT_EQ(ran.Out.find(message), 0u) << ran.Out;
    EXPECT_EQ(std::count(ran.Out.begin(), ran.Out.end(), '\n'), 1) << ran.Out;
  }
}
