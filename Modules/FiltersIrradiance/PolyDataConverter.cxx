#include "PolyDataConverter.h"

#include "InputError.h"
#include "PolygonTriangulation.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace irradiance
{

namespace
{

template <class Visit>
void forEachCell(vtkCellArray* cells, const Visit& visit)
{
  auto it = vtk::TakeSmartPointer(cells->NewIterator());
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    it->GetCurrentCell(count, ids);
    visit(count, ids);
  }
}

}

PolyDataConverter::PolyDataConverter(
  std::string where, vtkPolyData* input, const SurfaceArrays& arrays, int bands)
  : where_(std::move(where))
  , input_(input)
  , arrays_(arrays)
  , bands_(bands)
{
}

void PolyDataConverter::fail(const std::string& what) const
{
  throw InputError(where_ + ", cell " + std::to_string(cell_) + ": " + what);
}

ConvertedPolyData PolyDataConverter::convert()
{
  checkArray(arrays_.exitance, "radiant exitance");
  checkArray(arrays_.reflectance, "diffuse reflectance");
  checkArray(arrays_.flux, "radiant flux");
  for (vtkCellArray* cells :
    { input_->GetVerts(), input_->GetLines(), input_->GetPolys(), input_->GetStrips() })
  {
    if (!cells->IsValid())
    {
      throw InputError(where_ + ": the offsets of a cell array are not valid");
    }
  }
  Surface& surface = result_.surface;
  surface.bands = bands_;
  surface.numberOfCells = static_cast<std::size_t>(input_->GetNumberOfCells());
  const std::size_t values = surface.numberOfCells * static_cast<std::size_t>(bands_);
  surface.reflectance.assign(values, 0.0);
  surface.exitance.assign(arrays_.exitance ? values : 0, 0.0);

  readPointLights(input_->GetVerts());
  cell_ += input_->GetNumberOfLines(); // they have no surface
  readPolygons(input_->GetPolys());
  readStrips(input_->GetStrips());
  return std::move(result_);
}

void PolyDataConverter::checkArray(vtkDataArray* array, const char* meaning) const
{
  if (!array)
  {
    return;
  }
  std::ostringstream message;
  message << where_ << ": the array " << (array->GetName() ? array->GetName() : "(unnamed)") << " ("
          << meaning << ") has ";
  if (array->GetNumberOfTuples() != input_->GetNumberOfCells())
  {
    message << array->GetNumberOfTuples() << " tuples for " << input_->GetNumberOfCells()
            << " cells";
    throw InputError(message.str());
  }
  if (array->GetNumberOfComponents() != 1 && array->GetNumberOfComponents() != 3)
  {
    message << array->GetNumberOfComponents() << " components; 1 or 3 are possible";
    throw InputError(message.str());
  }
}

double PolyDataConverter::value(vtkDataArray* array, int band) const
{
  return array->GetComponent(cell_, array->GetNumberOfComponents() == 1 ? 0 : band);
}

void PolyDataConverter::readPoints(vtkIdType count, const vtkIdType* ids)
{
  corners_.clear();
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (ids[i] < 0 || ids[i] >= input_->GetNumberOfPoints())
    {
      fail("refers to point " + std::to_string(ids[i]) + " of " +
        std::to_string(input_->GetNumberOfPoints()));
    }
    Vector3 point;
    input_->GetPoint(ids[i], point.data());
    if (!point.allFinite())
    {
      std::ostringstream message;
      message << "point " << ids[i] << " is not finite (" << point.transpose() << ")";
      fail(message.str());
    }
    if (!(point.cwiseAbs().maxCoeff() <= kMostDistant))
    {
      std::ostringstream message;
      message << "point " << ids[i] << " is out of range (" << point.transpose() << ")";
      fail(message.str());
    }
    corners_.push_back(point);
  }
}

void PolyDataConverter::readPointLights(vtkCellArray* cells)
{
  forEachCell(cells, [this](vtkIdType count, const vtkIdType* ids) {
    if (arrays_.flux && count > 0)
    {
      readPoints(count, ids);
      PointLight light{ Vector3::Zero(), {} };
      double total = 0;
      for (int band = 0; band < bands_; ++band)
      {
        const double flux = value(arrays_.flux, band);
        if (!(flux >= 0 && flux <= kBrightest))
        {
          fail("radiant flux " + text(flux) + " W is not within 0.." + text(kBrightest));
        }
        light.flux.push_back(flux / static_cast<double>(count));
        total += flux;
      }
      for (const Vector3& corner : corners_)
      {
        light.position = corner;
        if (total > 0)
        {
          result_.surface.pointLights.push_back(light);
        }
      }
    }
    ++cell_;
  });
}

void PolyDataConverter::readPolygons(vtkCellArray* cells)
{
  forEachCell(cells, [this](vtkIdType count, const vtkIdType* ids) {
    readPoints(count, ids);
    firstTriangle_ = result_.triangles.size();
    if (!triangulate(corners_, result_.triangles) && result_.crossedCells++ == 0)
    {
      result_.firstCrossedCell = cell_;
    }
    readSurfaceCell();
    ++cell_;
  });
}

void PolyDataConverter::readStrips(vtkCellArray* cells)
{
  forEachCell(cells, [this](vtkIdType count, const vtkIdType* ids) {
    readPoints(count, ids);
    firstTriangle_ = result_.triangles.size();
    for (std::size_t i = 0; i + 2 < corners_.size(); ++i)
    {
      // Every other triangle of a strip runs the other way round.
      const std::size_t odd = i % 2;
      result_.triangles.push_back({ corners_[i], corners_[i + 1 + odd], corners_[i + 2 - odd] });
    }
    readSurfaceCell();
    ++cell_;
  });
}

/// The cell's triangles are there; its arrays and its area follow. Triangles without area are dropped:
/// they have no normal.
void PolyDataConverter::readSurfaceCell()
{
  Surface& surface = result_.surface;
  const auto cell = static_cast<std::size_t>(cell_);
  const auto isPoint = [](const Triangle& t) { return !(t.areaVector().norm() > kSmallestArea); };
  result_.triangles.erase(
    std::remove_if(result_.triangles.begin() + static_cast<std::ptrdiff_t>(firstTriangle_),
      result_.triangles.end(), isPoint),
    result_.triangles.end());
  double area = 0;
  for (std::size_t i = firstTriangle_; i < result_.triangles.size(); ++i)
  {
    surface.cellOfTriangle.push_back(static_cast<std::uint32_t>(cell));
    area += result_.triangles[i].areaVector().norm();
  }
  if (!(area > 0) && result_.cellsWithoutArea++ == 0)
  {
    result_.firstCellWithoutArea = cell_;
  }
  for (int band = 0; band < bands_; ++band)
  {
    const std::size_t slot =
      cell * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(band);
    const double reflectance =
      arrays_.reflectance ? value(arrays_.reflectance, band) : arrays_.defaultReflectance;
    if (!(reflectance >= 0 && reflectance <= 1))
    {
      fail("diffuse reflectance " + text(reflectance) + " is not within 0..1");
    }
    surface.reflectance[slot] = reflectance;
    if (arrays_.exitance)
    {
      const double exitance = value(arrays_.exitance, band);
      if (!(exitance >= 0 && exitance <= kBrightest))
      {
        fail("radiant exitance " + text(exitance) + " W/m2 is not within 0.." + text(kBrightest));
      }
      surface.exitance[slot] = exitance;
    }
  }
}

}
