// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// What holds for every output, stale or not.
namespace OutputChecks
{

using namespace TestScenes;

inline std::vector<vtkPolyData*> LeavesOf(vtkDataObject* data)
{
  std::vector<vtkPolyData*> leaves;
  RandomModels::ForEachLeaf(data, [&](vtkPolyData* leaf) { leaves.push_back(leaf); });
  return leaves;
}

inline std::vector<std::string> SidesOf(vtkIrradianceFilter* filter)
{
  return filter->GetSeparateSides() ? std::vector<std::string>{ "Front", "Back" }
                                    : std::vector<std::string>{ "" };
}

inline double MostStale(vtkIrradianceFilter* filter)
{
  return filter->GetOutput()->GetFieldData()->GetArray("StalePower")->GetRange(-1)[1];
}

inline void ExpectFinite(vtkFieldData* data)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const std::string name = data->GetArrayName(i);
    const bool mayBeUnknown = name.find("StandardError") != std::string::npos ||
      name == "ReachedRelativeError" || name == "StaleGainBound" || name == "PhongExponent";
    const bool isLight = name.find("Irradiance") != std::string::npos || name == "Radiance";
    vtkDataArray* array = data->GetArray(i);
    for (vtkIdType value = 0; array && !mayBeUnknown && value < array->GetNumberOfValues(); ++value)
    {
      const double number = array->GetVariantValue(value).ToDouble();
      ASSERT_TRUE(std::isfinite(number) && !(isLight && number < 0)) << name << " is " << number;
    }
  }
}

inline void ExpectBalance(vtkIrradianceFilter* filter)
{
  vtkFieldData* fields = filter->GetOutput()->GetFieldData();
  for (int band = 0; band < fields->GetArray("EmittedPower")->GetNumberOfComponents(); ++band)
  {
    const double emitted = Field(filter, "EmittedPower", band);
    EXPECT_NEAR(emitted, Field(filter, "AbsorbedPower", band) + Field(filter, "EscapedPower", band),
      1e-14 * emitted);
    EXPECT_LE(Field(filter, "StalePower", band), emitted);
  }
}

inline void ExpectSoundOutput(vtkIrradianceFilter* filter, const RandomModels::Model& model)
{
  vtkMultiBlockDataSet* output = filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfBlocks(), 2u);
  for (const unsigned int port : { 0u, 1u })
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
    ASSERT_EQ(blocks->GetNumberOfBlocks(), model.Ports[port].size());
  }
  ExpectFinite(output->GetFieldData());
  for (vtkPolyData* leaf : LeavesOf(output))
  {
    ExpectFinite(leaf->GetCellData());
    for (const std::string& side : SidesOf(filter))
    {
      ASSERT_TRUE(leaf->GetCellData()->HasArray(("Irradiance" + side).c_str()));
    }
  }
  ExpectBalance(filter);
}

/// None for other cells. vtkPolyData::GetCellPoints() fails where a polygon has one point or two.
inline void PointsOfPolygon(vtkPolyData* polyData, vtkIdType cell, vtkIdList* ids)
{
  ids->Reset();
  const vtkIdType polygon = cell - polyData->GetNumberOfVerts() - polyData->GetNumberOfLines();
  if (polygon >= 0 && polygon < polyData->GetNumberOfPolys())
  {
    polyData->GetPolys()->GetCellAtId(polygon, ids);
  }
}

inline double AreaOf(vtkPolyData* polyData, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  PointsOfPolygon(polyData, cell, ids);
  return vtkMath::Norm(PolygonNormal(polyData, ids).data()) / 2;
}

inline bool IsFar(vtkPolyData* leaf)
{
  const double* bounds = leaf->GetBounds();
  return std::any_of(bounds, bounds + 6, [](double x) { return std::abs(x) > 2e3; });
}

/// The full update takes at most the stale part from a cell, unless light is spread, and brings at
/// most the bound to all cells. Areas come from points that may be floats.
inline void ExpectBounds(
  vtkIrradianceFilter* now, vtkIrradianceFilter* full, double errorOfAreas = 1e-3)
{
  const auto before = LeavesOf(now->GetOutput()), after = LeavesOf(full->GetOutput());
  ASSERT_EQ(before.size(), after.size());
  const bool isFar = std::any_of(before.begin(), before.end(), IsFar);
  const bool isSpread = now->GetCellEstimate() == vtkIrradianceFilter::Spread;
  vtkDataArray* bound = now->GetOutput()->GetFieldData()->GetArray("StaleGainBound");
  for (int band = 0; bound && band < bound->GetNumberOfComponents(); ++band)
  {
    double brought = 0, received = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      for (const std::string& side : SidesOf(now))
      {
        const auto array = [&](vtkPolyData* leaf, const std::string& name) {
          return leaf->GetCellData()->GetArray((name + side).c_str());
        };
        for (vtkIdType cell = 0; cell < before[i]->GetNumberOfCells(); ++cell)
        {
          const auto value = [&](vtkDataArray* values) { return values->GetComponent(cell, band); };
          const double e = value(array(before[i], "Irradiance")),
                       stale = value(array(before[i], "StaleIrradiance")),
                       exact = value(array(after[i], "Irradiance")), area = AreaOf(before[i], cell);
          EXPECT_LE(stale, e * (1 + 1e-12)) << stale / e - 1;
          EXPECT_TRUE(isSpread || exact >= (e - stale) - 1e-12 * e) << exact << " of " << e;
          if (e > 0 || exact > 0) // the area of a degenerate cell may be NaN
          {
            brought += (exact - (e - stale)) * area;
            received += exact * area;
          }
        }
      }
    }
    // Of an object 1 km away, points in floats are known to 3e-5 m, and small cells to 1e-3 of
    // their area; of one that is farther away, nothing is known.
    EXPECT_TRUE(isFar || brought <= bound->GetComponent(0, band) + errorOfAreas * received)
      << brought << " of " << received << " for " << bound->GetComponent(0, band);
  }
}

}
