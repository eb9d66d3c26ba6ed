// SPDX-License-Identifier: BSD-3-Clause
// Which body a lamp file means, its size, and which of its faces shine.

#include "LuminaireFiles.h"

#include "vtkCell.h"
#include "vtkPolygon.h"

#include <map>

using namespace LuminaireFiles;

namespace
{

/// Area and outward normal of a face.
struct Face
{
  double Area, Normal[3], Middle[3];
};

std::vector<Face> FacesOf(vtkPolyData* lamp)
{
  std::vector<Face> faces;
  for (vtkIdType cell = 0; cell < lamp->GetNumberOfCells(); ++cell)
  {
    vtkPoints* points = lamp->GetCell(cell)->GetPoints();
    Face face{ 0, {}, { 0, 0, 0 } };
    face.Area = vtkPolygon::ComputeArea(points, points->GetNumberOfPoints(), nullptr, face.Normal);
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      vtkMath::Add(face.Middle, points->GetPoint(i), face.Middle);
    }
    vtkMath::MultiplyScalar(face.Middle, 1. / static_cast<double>(points->GetNumberOfPoints()));
    faces.push_back(face);
  }
  return faces;
}

/// How large the faces look together.
double AreaFrom(vtkPolyData* lamp, const Direction& d)
{
  double area = 0;
  for (const Face& face : FacesOf(lamp))
  {
    area += face.Area * std::max(0., vtkMath::Dot(face.Normal, d.data()));
  }
  return area;
}

std::array<double, 3> SizeOf(vtkPolyData* lamp)
{
  double bounds[6];
  lamp->GetBounds(bounds);
  return { bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] };
}

vtkSmartPointer<vtkPolyData> ReadOpening(const std::string& version, const std::string& size)
{
  Ies file;
  file.Version = version;
  file.Size = size;
  return Read(file.Text());
}

const char* const k1986 = "a lamp";
const char* const k1995 = "IESNA:LM-63-1995";
const char* const k2002 = "IESNA:LM-63-2002";
const char* const k2019 = "IES:LM-63-2019";

}

TEST(LuminousOpening, SignsSayTheShape)
{
  struct Case
  {
    std::vector<std::string> Versions;
    std::string Size, Shape;
  };
  const std::vector<std::string> all{ k1986, "IESNA91", k1995, k2002, k2019 };
  const std::vector<std::string> old{ k1986, "IESNA91" }, recent{ k2002, k2019 };
  const std::vector<Case> cases{ { all, "0 0 0", "point" }, { all, ".2 .3 0", "rectangle" },
    { all, ".2 0 0", "rectangle" }, { all, ".2 .3 .1", "box" }, { all, ".2 0 .1", "box" },
    { all, "0 .3 .1", "box" }, { all, "-.2 0 0", "disc" }, { all, "-.2 -.2 0", "disc" },
    { all, "-.2 .3 0", "ellipse" }, { all, "-.2 -.3 0", "ellipse" },
    { all, "-.2 0 .1", "vertical cylinder" }, { all, "-.2 -.2 .1", "vertical cylinder" },
    { all, "-.2 -.3 .1", "vertical elliptical cylinder" }, { old, "-.2 .3 .1", "ellipsoid" },
    { { k1995, k2002, k2019 }, "-.2 .3 .1", "vertical elliptical cylinder" },
    { { k1995, k2002, k2019 }, ".2 -.3 .1", "vertical elliptical cylinder" },
    { all, "-.2 -.2 -.2", "sphere" }, { all, "-.2 -.2 -.3", "ellipsoid" },
    { { k1995 }, "-.2 0 -.2", "sphere" }, { { k1995 }, "-.2 .3 -.1", "ellipsoid" },
    { { k1995 }, ".2 -.3 -.1", "ellipsoid" }, { recent, "-.2 0 -.2", "vertical disc" },
    { recent, "-.2 0 -.3", "vertical ellipse" },
    { all, "0 .6 -.1", "horizontal cylinder along the length" },
    { recent, "-.1 .6 -.1", "horizontal cylinder along the length" },
    { recent, "-.2 .6 -.1", "horizontal elliptical cylinder along the length" },
    { all, ".6 0 -.1", "horizontal cylinder across" },
    { recent, ".6 -.1 -.1", "horizontal cylinder across" },
    { recent, ".6 -.2 -.1", "horizontal elliptical cylinder across" } };
  for (const Case& c : cases)
  {
    for (const std::string& version : c.Versions)
    {
      SCOPED_TRACE(version + ": " + c.Size);
      const auto lamp = ReadOpening(version, c.Size);
      EXPECT_EQ(Word(lamp, "LuminousShape"), c.Shape);
      EXPECT_EQ(lamp->GetNumberOfVerts(), c.Shape == "point" ? 1 : 0);
      for (const Face& face : FacesOf(lamp)) // closed, and outward
      {
        EXPECT_TRUE(c.Shape == "point" || vtkMath::Dot(face.Normal, face.Middle) > 0);
      }
    }
  }
  const auto reader = MakeReader(Ies{ k2002, "", "NONE\n", "1 -1 1", 1, 2, ".2 .3 -.1" }.Text());
  ExpectOne(Update(reader).Errors, { "lamp.any, line 8", "no luminous opening", "width 0.2" });
}

TEST(LuminousOpening, LengthIsAlongX)
{
  using Size = std::array<double, 3>;
  EXPECT_EQ(SizeOf(ReadOpening(k2002, ".2 .3 .1")), (Size{ .3, .2, .1 }));
  EXPECT_EQ(SizeOf(ReadOpening(k2002, "0 .3 .1")), (Size{ .3, .001, .1 }));
  const Size along = SizeOf(ReadOpening(k2002, "-.1 .6 -.1")),
             across = SizeOf(ReadOpening(k2002, ".6 -.1 -.1")),
             disc = SizeOf(ReadOpening(k2002, "-.2 0 -.2"));
  EXPECT_NEAR(along[0], 0.6, 1e-15);
  EXPECT_NEAR(along[1], 0.1, 0.002);
  EXPECT_NEAR(across[1], 0.6, 1e-15);
  EXPECT_NEAR(across[2], 0.1, 0.002);
  EXPECT_NEAR(disc[0], 0.001, 1e-15); // two faces
  EXPECT_NEAR(disc[2], 0.2, 0.002);
  Ies feet;
  feet.Units = 1;
  feet.Size = "1 2 3";
  const Size size = SizeOf(Read(feet.Text()));
  EXPECT_NEAR(size[0], 0.6096, 1e-15);
  EXPECT_NEAR(size[1], 0.3048, 1e-15);
  EXPECT_NEAR(size[2], 0.9144, 1e-15);
}

TEST(LuminousOpening, FacetsAreAsLargeAsWhatTheyStandFor)
{
  const double pi = vtkMath::Pi();
  EXPECT_NEAR(AreaFrom(ReadOpening(k2002, "-.2 -.4 0"), { 0, 0, -1 }), pi / 4 * .08, 1e-12);
  const auto cylinder = ReadOpening(k2002, "-.2 -.2 .5");
  EXPECT_EQ(cylinder->GetNumberOfCells(), 18);
  EXPECT_NEAR(AreaFrom(cylinder, { 0, 0, 1 }), pi / 4 * .04, 1e-12);
  EXPECT_NEAR(AreaFrom(cylinder, { 1, 0, 0 }), .2 * .5, .2 * .5 * .02);
  const auto sphere = ReadOpening(k2002, "-2 -2 -2");
  EXPECT_EQ(sphere->GetNumberOfCells(), 96);
  double surface = 0;
  for (const Face& face : FacesOf(sphere))
  {
    surface += face.Area;
  }
  EXPECT_NEAR(surface, 4 * pi, 1e-12); // four times what it looks like in the mean
  EXPECT_NEAR(AreaFrom(sphere, { 0, 0, -1 }), pi, .03 * pi);
}

TEST(LuminousOpening, OnlyFacesWithLightAreThere)
{
  Ies file;
  using Middles = std::map<std::array<int, 3>, long>; // heights, 1e-6 m
  const auto normals = [&](double first, double last, const std::string& size) {
    file.Size = size;
    file.V = Steps(first, last, 15);
    Middles middles; // by normal
    for (const Face& face : FacesOf(Read(file.Text())))
    {
      middles[{ static_cast<int>(std::lround(face.Normal[0])),
        static_cast<int>(std::lround(face.Normal[1])),
        static_cast<int>(std::lround(face.Normal[2])) }] = std::lround(1e6 * face.Middle[2]);
    }
    return middles;
  };
  const std::array<int, 3> down{ 0, 0, -1 }, up{ 0, 0, 1 };
  EXPECT_EQ(normals(0, 90, ".2 .3 0"), (Middles{ { down, 0 } }));
  EXPECT_EQ(normals(90, 180, ".2 .3 0"), (Middles{ { up, 0 } }));
  EXPECT_EQ(normals(0, 180, ".2 .3 0"), (Middles{ { down, -500 }, { up, 500 } }));
  EXPECT_EQ(normals(0, 180, "-.2 0 0"), (Middles{ { down, -500 }, { up, 500 } }));
  EXPECT_EQ(normals(0, 180, ".2 .3 .1").size(), 6u);
  const Middles lower = normals(0, 90, ".2 .3 .1"), upper = normals(90, 180, ".2 .3 .1");
  EXPECT_EQ(lower.size(), 5u);
  EXPECT_EQ(lower.count(up), 0u);
  EXPECT_EQ(upper.size(), 5u);
  EXPECT_EQ(upper.count(down), 0u);
  // Angles at which the table has nothing are as good as none.
  file.Value = [](double v, double) { return v < 90 ? 1. : 0.; };
  EXPECT_EQ(normals(0, 180, ".2 .3 0"), (Middles{ { down, 0 } }));
  file.Value = [](double v, double h) { return v < 90 && h > 0 && h < 180 ? 1. : 0.; };
  EXPECT_EQ(normals(0, 180, ".2 .3 .1").size(), 4u); // below, both ends, one side
  EXPECT_EQ(normals(0, 180, ".2 .3 .1").count({ 0, -1, 0 }), 0u);
  file.Type = 2; // B
  file.H = Steps(-90, 90, 30);
  file.Value = [](double, double) { return 1.; };
  EXPECT_EQ(normals(-90, 90, ".2 .3 0"), (Middles{ { down, 0 } }));
}

TEST(LuminousOpening, OfEulumdatIsInMillimetresAlongY)
{
  Eulumdat file;
  const auto read = [&](const std::string& size) {
    file.LitSize = size;
    return Read(file.Text());
  };
  using Size = std::array<double, 3>;
  const auto point = read("0\n0\n0\n0\n0\n0\n"), box = read("1200\n300\n10\n20\n\n5\n"),
             rectangle = read("1200\n300\n0\n0\n0\n0\n"), disc = read("200\n0\n0\n0\n0\n0\n"),
             cylinder = read("200\n0\n50\n50\n50\n50\n");
  EXPECT_EQ(Word(point, "LuminousShape"), "point");
  EXPECT_EQ(Word(box, "LuminousShape"), "box");
  EXPECT_EQ(SizeOf(box), (Size{ .3, 1.2, .02 }));
  EXPECT_EQ(Word(rectangle, "LuminousShape"), "rectangle");
  EXPECT_EQ(Word(disc, "LuminousShape"), "disc");
  EXPECT_NEAR(AreaFrom(disc, { 0, 0, -1 }), vtkMath::Pi() * .01, 1e-12);
  EXPECT_EQ(Word(cylinder, "LuminousShape"), "vertical cylinder");
}
