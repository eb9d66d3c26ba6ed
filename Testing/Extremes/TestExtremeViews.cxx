// SPDX-License-Identifier: BSD-3-Clause
// An eye and sensors that are very near, very far, inside of objects, or in the plane of a cell;
// and scenes of all lengths. In a furnace all that an eye sees is 1 / pi W/m2/sr, and a sensor on a
// surface receives 1 W/m2.

#include "../FiltersIrradiance/ViewFilters.h"
#include "ExtremeScenes.h"

#include "vtkTriangle.h"

#include <limits>
#include <numeric>

using namespace ExtremeScenes;
using RandomModels::View;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr vtkIdType NumberOfWalks = 20000;
/// Narrower lobes have too few photons, see vtkOutgoingRadianceFilter.
const std::vector<double> Exponents{ 0, 7, 30, Infinity };

/// In the middles of the cells of a mesh of squares, in front.
Mesh MakeSensorsOn(vtkPolyData* squares)
{
  std::vector<Vector> positions, normals;
  for (vtkIdType cell = 0; cell < squares->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    squares->GetCellPoints(cell, ids);
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      squares->GetPoint(ids->GetId(i), p[i]);
    }
    Vector normal;
    vtkTriangle::ComputeNormal(p[0], p[1], p[2], normal.data());
    normals.push_back(normal);
    positions.push_back({ 0.5 * p[0][0] + 0.5 * p[2][0], 0.5 * p[0][1] + 0.5 * p[2][1],
      0.5 * p[0][2] + 0.5 * p[2][2] });
  }
  return MakeSensors(positions, normals);
}

double MeanOf(vtkDataArray* array)
{
  const std::vector<double> values = ValuesOf(array);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

vtkDataArray* RadianceOf(const ViewFilters& views, unsigned int port, unsigned int i)
{
  return OutputOf(views.Radiance->GetOutput(), port, i)->GetCellData()->GetArray("Radiance");
}

vtkDataArray* Measured(const ViewFilters& views, const char* name)
{
  return views.Probe->GetOutput()->GetPointData()->GetArray(name);
}

Mesh MakeGlossyBox()
{
  return Glossy(White(MakeBox(0.3, 0.2, 0.25)), 0.4, Exponents);
}

/// A glossy furnace and a glossy box that moves in it, watched from inside and by sensors. From the
/// scatter of its cells the mean radiance has a standard deviation of 0.0036, of 30 seeds the
/// sensors' mean 0.0093: tolerances are 5.5 of them, a false alarm in 20 million.
void ExpectWatchedFurnace(const FurnacePlace& place)
{
  const auto& [size, offset] = place;
  Scene scene{ { Glossy(MakeFurnace(size, offset), 0.4, Exponents) },
    { MakeMovingIn(MakeGlossyBox(), size, offset, { 0.4, 0.5, 0.6 }) } };
  View view;
  view.HasEye = view.HasSensors = true;
  view.Eye = { offset[0] + 0.5 * size, offset[1] + 0.4 * size, offset[2] + 0.3 * size };
  view.Sensors = MakeSensorsOn(scene.Fixed[0]);
  view.NumberOfPhotons = 200;
  view.NumberOfSpecularSamples = 64;
  const auto filter = MakeFilter(scene, NumberOfWalks);
  ViewFilters views(filter);
  views.Apply(view);
  for (int frame = 0; frame < 3; ++frame)
  {
    SCOPED_TRACE("frame " + std::to_string(frame));
    views.Update();
    ASSERT_NO_FATAL_FAILURE(views.ExpectSound());
    const auto fresh = MakeFilter(scene, NumberOfWalks);
    ViewFilters freshViews(fresh);
    freshViews.Apply(view);
    freshViews.Update();
    EXPECT_TRUE(IsSame(views, freshViews));
    EXPECT_NEAR(vtkMath::Pi() * MeanOf(RadianceOf(views, 0, 0)), 1, 0.02);
    EXPECT_NEAR(MeanOf(Measured(views, "Irradiance")), 1, 0.052);
    scene.Moving[0].Pose->RotateWXYZ(25, 1, 2, 3);
    scene.Moving[0].Pose->Translate(0.05 * size, 0.1 * size, -0.1 * size);
  }
}

/// The floor of the furnace, in whose middle the origin is, and the eye.
struct WatchedFurnace
{
  Scene Given{ { Glossy(MakeFurnace(1, { -0.5, -0.5, 0 }), 0.4, Exponents) },
    { MakeMoving(MakeGlossyBox(), { 0, 0, 0.5 }) } };
  vtkSmartPointer<vtkIrradianceFilter> Filter = MakeFilter(this->Given, NumberOfWalks);
  ViewFilters Views{ this->Filter };
  View Look;

  WatchedFurnace()
  {
    this->Filter->SeparateSidesOn();
    this->Look.NumberOfSpecularSamples = 16;
  }
  void See(const Vector& eye, bool isFar = false)
  {
    this->Look.HasEye = true;
    this->Look.Eye = eye;
    this->Look.IsFar = isFar;
    this->Update();
  }
  void Update()
  {
    this->Views.Apply(this->Look);
    this->Views.Update();
    ASSERT_NO_FATAL_FAILURE(this->Views.ExpectSound());
  }
  std::vector<double> Seen()
  {
    std::vector<double> values;
    for (const unsigned int port : { 0u, 1u })
    {
      const std::vector<double> some = ValuesOf(RadianceOf(this->Views, port, 0));
      values.insert(values.end(), some.begin(), some.end());
    }
    return values;
  }
};

class ExtremeViewsOfFurnaces : public testing::TestWithParam<FurnacePlace>
{
};

}

TEST_P(ExtremeViewsOfFurnaces, Hold)
{
  ExpectWatchedFurnace(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Each, ExtremeViewsOfFurnaces,
  PlacesOf({ 1e-28, 1e-6, 1.0, 1e12, 1e28 }, { 1e3, 1e5, 1e7 }), NumberOf);

// From far away an eye sees what it sees from infinitely far away, even where the square of its
// distance is too large for a double.
TEST(ExtremeViews, AFarEyeSeesAsAnInfinitelyFarOne)
{
  WatchedFurnace furnace;
  furnace.See({ 0.2, 1, 0.7 }, true);
  const std::vector<double> expected = furnace.Seen();
  for (const double far : { 1e9, 1e20, 1e100, 1e153, 1e160, 1e200, 1e300, 1.7e308 })
  {
    SCOPED_TRACE(far);
    furnace.See({ 0.2 * far, far, 0.7 * far });
    const std::vector<double> seen = furnace.Seen();
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(seen[i], expected[i], 1e-6 * (1 + expected[i])) << "cell " << i;
    }
  }
}

// Above the middle of a cell of the floor, which is the origin, as low as a double can be; most of
// the floor is seen at grazing angles, where lobes are noisy.
TEST(ExtremeViews, AnEyeNearACell)
{
  WatchedFurnace furnace;
  for (const double near : { 1e-3, 1e-9, 1e-30, 1e-160, 1e-200, 1e-300, 5e-324 })
  {
    SCOPED_TRACE(near);
    furnace.See({ 0, 0, near });
    EXPECT_NEAR(vtkMath::Pi() * MeanOf(RadianceOf(furnace.Views, 0, 0)), 1, 0.02);
  }
}

// In the plane of the floor nothing of its lobes is seen: light emitted and reflected diffusely
// remains, and what mirrors show.
TEST(ExtremeViews, AnEyeInThePlaneOfACell)
{
  WatchedFurnace furnace;
  for (const Vector& eye : { Vector{ 0, 0, 0 }, Vector{ 0.1, -0.2, 0 }, Vector{ -0.5, -0.5, 0 },
         Vector{ 7, 0, 0 }, Vector{ 1e200, -3, 0 } })
  {
    furnace.See(eye);
    vtkDataArray* radiance = RadianceOf(furnace.Views, 0, 0);
    vtkDataArray* irradiance =
      OutputOf(furnace.Filter->GetOutput(), 0, 0)->GetCellData()->GetArray("IrradianceFront");
    for (const vtkIdType cell : { 0, 1, 2, 4, 5, 6, 8 }) // of the floor, but no mirrors
    {
      const double expected = 0.5 + 0.3 * irradiance->GetComponent(cell, 0);
      EXPECT_NEAR(vtkMath::Pi() * radiance->GetComponent(cell, 0), expected, 1e-12) << cell;
    }
    EXPECT_LT(radiance->GetComponent(3, 0), 1);
  }
}

// Inside the box all is dark, also what its mirrors show, however close the eye is to a wall of it.
TEST(ExtremeViews, AnEyeInsideABodySeesItsDarkInside)
{
  WatchedFurnace furnace;
  for (const Vector& eye :
    { Vector{ 0, 0, 0.5 }, Vector{ 0.149999999, 0.0999999, 0.6249999 }, Vector{ 1e-160, 0, 0.5 } })
  {
    furnace.See(eye);
    const std::vector<double> radiance = ValuesOf(RadianceOf(furnace.Views, 1, 0));
    EXPECT_EQ(radiance, std::vector<double>(radiance.size()));
  }
}

// From any distance, if that is allowed, a sensor stands on the closest surface that faces it and
// is not inside of a body or outside of the room. Asked for more photons than there are, it takes
// all of these.
TEST(ExtremeViews, AFarSensorStandsOnTheClosestSurfaceThatFacesIt)
{
  WatchedFurnace furnace;
  furnace.Look.HasSensors = true;
  furnace.Look.NumberOfPhotons = 1000000;
  furnace.Look.MaximumRadius = furnace.Look.MaximumDistance = Infinity;
  for (const double far : { 0.0, 0.2, 1e3, 5e5 })
  {
    furnace.Look.Sensors = MakeSensors({ { far, 0, 0.5 }, { -far, far, 0 }, { 0, 0, far } },
      { { 1, 0, 0 }, { 0, -2, 0 }, { 0, 0, 5 } });
    furnace.Update();
    for (vtkIdType i = 0; i < 3; ++i)
    {
      const double irradiance = Measured(furnace.Views, "Irradiance")->GetComponent(i, 0);
      const double photons = Measured(furnace.Views, "NumberOfPhotons")->GetComponent(i, 0);
      ASSERT_GT(photons, 30);
      EXPECT_NEAR(irradiance, 1, 6 / std::sqrt(photons)) // 6 standard errors
        << "sensor " << i << " from " << far << " m, " << photons << " photons";
    }
  }
}

// Beyond a million sizes of the scene digits do not suffice to tell what is near: not known,
// whatever is asked for; never a false 0. The filter stays usable.
TEST(ExtremeViews, ASensorTooFarAwayKnowsNothing)
{
  WatchedFurnace furnace;
  furnace.Look.HasSensors = true;
  for (const int photons : { 2, 50, 1000000 })
  {
    furnace.Look.NumberOfPhotons = photons;
    for (const double far : { 1e7, 1e8, 1e15, 1e20, 1e40, 1e160, 1e300, 1.7e308 })
    {
      SCOPED_TRACE(far);
      furnace.Look.Sensors = MakeSensors({ { far, 0, 0 }, { 0, -far, far }, { 0.1, 0.1, 0 } },
        { { 1, 0, 0 }, { 1e-200, 1e-300, 0 }, { 0, 0, 1 } });
      ASSERT_NO_FATAL_FAILURE(furnace.Update());
      for (const vtkIdType i : { 0, 1 })
      {
        EXPECT_TRUE(std::isnan(Measured(furnace.Views, "Irradiance")->GetComponent(i, 0)));
        EXPECT_EQ(Measured(furnace.Views, "NumberOfPhotons")->GetComponent(i, 0), 0);
      }
      EXPECT_GT(Measured(furnace.Views, "Irradiance")->GetComponent(2, 0), 0);
    }
  }
}
