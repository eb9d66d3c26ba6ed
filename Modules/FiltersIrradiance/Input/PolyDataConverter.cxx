// SPDX-License-Identifier: BSD-3-Clause
#include "Input/PolyDataConverter.h"

#include "Meshes/PolygonTriangulation.h"
#include "Progress/InputError.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

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

void ConvertedPolyData::reserve(const std::vector<vtkPolyData*>& inputs)
{
  vtkIdType cells = 0, mostTriangles = 0;
  for (vtkPolyData* input : inputs)
  {
    cells += input->GetNumberOfCells();
    // A polygon of n corners becomes n - 2 triangles.
    mostTriangles += std::max<vtkIdType>(0,
      input->GetPolys()->GetNumberOfConnectivityIds() - 2 * input->GetNumberOfPolys() +
        input->GetStrips()->GetNumberOfConnectivityIds());
  }
  triangles.reserve(static_cast<std::size_t>(mostTriangles));
  material.cellOfTriangle.reserve(static_cast<std::size_t>(mostTriangles));
  material.reflectance.reserve(static_cast<std::size_t>(cells * material.bands));
}

PolyDataConverter::PolyDataConverter(std::string where, vtkPolyData* input,
  const MaterialArrays<vtkDataArray>& arrays, double defaultReflectance, ConvertedPolyData& target,
  const CancelPoint& cancelPoint)
  : where_(std::move(where))
  , input_(input)
  , arrays_(arrays)
  , defaultReflectance_(defaultReflectance)
  , target_(target)
  , bands_(target.material.bands)
  , pace_(cancelPoint)
  , ghosts_(input->GetCellGhostArray())
  , firstCell_(target.material.numberOfCells)
{
}

void PolyDataConverter::fail(const std::string& what) const
{
  throw InputError(where_ + ", cell " + std::to_string(cell_) + ": " + what);
}

std::vector<InputWarning> PolyDataConverter::convert()
{
  for (std::size_t number = 0; number < arrays_.size(); ++number)
  {
    checkArray(number);
  }
  for (vtkCellArray* cells :
    { input_->GetVerts(), input_->GetLines(), input_->GetPolys(), input_->GetStrips() })
  {
    if (!cells->IsValid())
    {
      throw InputError(where_ + ": the offsets of a cell array are not valid");
    }
  }
  makeRoom();
  readPointLights(input_->GetVerts());
  readLines();
  readPolygons(input_->GetPolys());
  readStrips(input_->GetStrips());
  checkMisplaced();
  return warnings();
}

void PolyDataConverter::makeRoom()
{
  Material& material = target_.material;
  const auto bands = static_cast<std::size_t>(bands_);
  material.numberOfCells += static_cast<std::size_t>(input_->GetNumberOfCells());
  material.reflectance.resize(material.numberOfCells * bands, 0.0);
  if (arrays_[Exitance] || !target_.emission.exitance.empty())
  {
    target_.emission.exitance.resize(material.numberOfCells * bands, 0.0);
  }
  if (arrays_[Specular] || !target_.specular.empty())
  {
    target_.specular.resize(material.numberOfCells * bands, 0.0);
    target_.exponents.resize(material.numberOfCells, kInfinity);
  }
}

bool PolyDataConverter::isGhost() const
{
  constexpr int kAbsent = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  return ghosts_ && (ghosts_->GetValue(cell_) & kAbsent) != 0;
}

double PolyDataConverter::largest(vtkDataArray* array) const
{
  double largest = 0;
  for (int band = 0; array && band < bands_; ++band)
  {
    largest = std::max(largest, value(array, band));
  }
  return largest;
}

/// An input that gives light to cells of the wrong kind only is an error.
void PolyDataConverter::checkMisplaced() const
{
  const bool hasSurface = input_->GetNumberOfPolys() + input_->GetNumberOfStrips() > 0;
  if (fluxElsewhere_.count > 0 && input_->GetNumberOfVerts() == 0)
  {
    throw InputError(where_ + ", cell " + std::to_string(fluxElsewhere_.first) +
      ": has a radiant flux but is no vertex; surfaces emit by their radiant exitance, W/m2");
  }
  if (exitanceElsewhere_.count > 0 && !hasSurface)
  {
    throw InputError(where_ + ", cell " + std::to_string(exitanceElsewhere_.first) +
      ": has a radiant exitance but no surface; vertices emit by their radiant flux, W");
  }
}

std::vector<InputWarning> PolyDataConverter::warnings() const
{
  std::vector<InputWarning> warnings;
  const auto add = [&](const OddCells& cells, const char* what, const char* consequence) {
    if (cells.count > 0)
    {
      warnings.push_back({ where_, what, consequence, cells.count, cells.first });
    }
  };
  add(withoutArea_, "have no area", "their irradiance is 0");
  add(crossed_, "are polygons that cross themselves", "what lies inside is not clear");
  add(fluxElsewhere_, "have a radiant flux but are no vertices", "it is not read there");
  add(exitanceElsewhere_, "have a radiant exitance but no surface", "it is not read there");
  if (arrays_[Exponent] && !arrays_[Specular])
  {
    warnings.push_back(
      { where_, ": has Phong exponents but no specular reflectance; they are not read" });
  }
  return warnings;
}

void PolyDataConverter::checkArray(std::size_t number) const
{
  vtkDataArray* array = arrays_[number];
  if (!array)
  {
    return;
  }
  std::ostringstream message;
  message << where_ << ": the array " << (array->GetName() ? array->GetName() : "(unnamed)") << " ("
          << kArrayRoles[number].meaning << ") has ";
  const vtkIdType cells = input_->GetNumberOfCells();
  const bool mayHaveThree = number != Exponent;
  std::ostringstream shape;
  shape << "; in NumPy its shape is (" << cells << ",)";
  if (mayHaveThree)
  {
    shape << " or (" << cells << ", 3)";
  }
  if (array->GetNumberOfTuples() != cells)
  {
    message << array->GetNumberOfTuples() << " tuples for " << cells << " cells" << shape.str();
    throw InputError(message.str());
  }
  if (array->GetNumberOfComponents() != 1 && !(mayHaveThree && array->GetNumberOfComponents() == 3))
  {
    message << array->GetNumberOfComponents() << " components; "
            << (mayHaveThree ? "1 or 3 are possible" : "1 is possible") << shape.str()
            << ", and append() repeats an array of any other length in each cell";
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
    pace_.step();
    const bool isAbsent = isGhost();
    if (!isAbsent && largest(arrays_[Exitance]) > 0)
    {
      exitanceElsewhere_.add(cell_);
    }
    if (arrays_[Flux] && count > 0 && !isAbsent)
    {
      readPoints(count, ids);
      PointSource light{ Vector3::Zero(), {},
        static_cast<std::uint32_t>(firstCell_ + static_cast<std::size_t>(cell_)) };
      double total = 0;
      for (int band = 0; band < bands_; ++band)
      {
        const double flux = value(arrays_[Flux], band);
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
          target_.emission.points.push_back(light);
        }
      }
    }
    ++cell_;
  });
}

/// Lines have no surface, but may carry a flux or an exitance.
void PolyDataConverter::readLines()
{
  const vtkIdType end = cell_ + input_->GetNumberOfLines();
  for (; cell_ < end && (arrays_[Flux] || arrays_[Exitance]); ++cell_)
  {
    pace_.step();
    if (!isGhost() && largest(arrays_[Flux]) > 0)
    {
      fluxElsewhere_.add(cell_);
    }
    if (!isGhost() && largest(arrays_[Exitance]) > 0)
    {
      exitanceElsewhere_.add(cell_);
    }
  }
  cell_ = end;
}

void PolyDataConverter::readPolygons(vtkCellArray* cells)
{
  forEachCell(cells, [this](vtkIdType count, const vtkIdType* ids) {
    pace_.step();
    if (!isGhost())
    {
      readPoints(count, ids);
      firstTriangle_ = target_.triangles.size();
      if (!triangulate(corners_, target_.triangles))
      {
        crossed_.add(cell_);
      }
      readSurfaceCell();
    }
    ++cell_;
  });
}

void PolyDataConverter::readStrips(vtkCellArray* cells)
{
  forEachCell(cells, [this](vtkIdType count, const vtkIdType* ids) {
    pace_.step(static_cast<std::size_t>(count));
    if (!isGhost())
    {
      readPoints(count, ids);
      firstTriangle_ = target_.triangles.size();
      for (std::size_t i = 0; i + 2 < corners_.size(); ++i)
      {
        // Every other triangle of a strip has the opposite orientation.
        const std::size_t odd = i % 2;
        target_.triangles.push_back({ corners_[i], corners_[i + 1 + odd], corners_[i + 2 - odd] });
      }
      readSurfaceCell();
    }
    ++cell_;
  });
}

/// Reads the arrays of a cell whose triangles have been added. Triangles without area are dropped,
/// as they have no normal.
void PolyDataConverter::readSurfaceCell()
{
  Material& material = target_.material;
  const std::size_t cell = firstCell_ + static_cast<std::size_t>(cell_);
  const auto isPoint = [](const Triangle& t) { return !(t.areaVector().norm() > kSmallestArea); };
  target_.triangles.erase(
    std::remove_if(target_.triangles.begin() + static_cast<std::ptrdiff_t>(firstTriangle_),
      target_.triangles.end(), isPoint),
    target_.triangles.end());
  double area = 0;
  for (std::size_t i = firstTriangle_; i < target_.triangles.size(); ++i)
  {
    material.cellOfTriangle.push_back(static_cast<std::uint32_t>(cell));
    area += target_.triangles[i].areaVector().norm();
  }
  if (!(area > 0))
  {
    withoutArea_.add(cell_);
  }
  if (largest(arrays_[Flux]) > 0)
  {
    fluxElsewhere_.add(cell_);
  }
  readReflectance(cell);
  for (int band = 0; arrays_[Exitance] && band < bands_; ++band)
  {
    const double exitance = value(arrays_[Exitance], band);
    if (!(exitance >= 0 && exitance <= kBrightest))
    {
      fail("radiant exitance " + text(exitance) + " W/m2 is not within 0.." + text(kBrightest));
    }
    target_.emission
      .exitance[cell * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(band)] =
      exitance;
  }
}

void PolyDataConverter::readReflectance(std::size_t cell)
{
  for (int band = 0; band < bands_; ++band)
  {
    const std::size_t slot =
      cell * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(band);
    const double diffuse =
      arrays_[Reflectance] ? value(arrays_[Reflectance], band) : defaultReflectance_;
    if (!(diffuse >= 0 && diffuse <= 1))
    {
      fail("diffuse reflectance " + text(diffuse) + " is not within 0..1");
    }
    target_.material.reflectance[slot] = diffuse;
    if (arrays_[Specular])
    {
      const double specular = value(arrays_[Specular], band);
      if (!(specular >= 0 && specular <= 1))
      {
        fail("specular reflectance " + text(specular) + " is not within 0..1");
      }
      if (!(diffuse + specular <= 1 + kRounding))
      {
        fail("diffuse reflectance " + text(diffuse) + " and specular reflectance " +
          text(specular) + " add up to more than 1");
      }
      target_.specular[slot] = std::min(specular, 1 - diffuse);
    }
  }
  if (arrays_[Exponent])
  {
    const double exponent = value(arrays_[Exponent], 0);
    if (!(exponent >= 0))
    {
      fail("Phong exponent " + text(exponent) + " is not 0 or more");
    }
    if (!target_.specular.empty())
    {
      target_.exponents[cell] = exponent;
    }
  }
}

}
