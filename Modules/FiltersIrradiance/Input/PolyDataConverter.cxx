// SPDX-License-Identifier: BSD-3-Clause
#include "Input/PolyDataConverter.h"

#include "Input/LuminaireFields.h"
#include "Input/PartCells.h"
#include "Meshes/PolygonTriangulation.h"
#include "Progress/InputError.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <optional>
#include <sstream>

namespace irradiance
{

namespace
{

class PolyDataConverter
{
public:
  PolyDataConverter(const std::string& where, vtkPolyData* input,
    const MaterialArrays<vtkDataArray>& arrays, double defaultReflectance,
    ConvertedPolyData& target, const CancelPoint& cancelPoint)
    : where_(where)
    , input_(input)
    , arrays_(arrays)
    , defaultReflectance_(defaultReflectance)
    , target_(target)
    , pace_(cancelPoint)
  {
  }

  std::vector<InputWarning> convert()
  {
    for (std::size_t number = 0; number < arrays_.size(); ++number)
    {
      checkArray(number);
    }
    for (vtkCellArray* cells :
      { input_->GetVerts(), input_->GetLines(), input_->GetPolys(), input_->GetStrips() })
    {
      throwIf(!cells->IsValid(), where_, ": the offsets of a cell array are not valid");
    }
    luminaire_ = readLuminaires(where_, input_, bands_);
    for (const MaterialArray light : { Exitance, Flux })
    {
      throwIf(luminaire_ && arrays_[light], where_, ": has a table of radiant intensity and a ",
        kArrayMeanings[light], "; only one of them can give its light");
    }
    makeRoom();
    const std::size_t firstTriangle = target_.triangles.size();
    readPointLights();
    readLines();
    readSurfaces(input_->GetPolys(), [this] {
      if (!triangulate(corners_, target_.triangles))
      {
        note(crossed_);
      }
    });
    readSurfaces(input_->GetStrips(), [this] {
      for (std::size_t i = 0; i + 2 < corners_.size(); ++i)
      {
        // Every other triangle of a strip has the opposite orientation.
        const std::size_t odd = i % 2;
        target_.triangles.push_back({ corners_[i], corners_[i + 1 + odd], corners_[i + 2 - odd] });
      }
    });
    checkMisplaced();
    if (luminaire_)
    {
      addLuminaires(*luminaire_, firstCell_, firstTriangle, target_);
    }
    return warnings();
  }

private:
  /// Limit beyond which products of powers might not be finite, W/m2, W.
  static constexpr double kBrightest = 1e30;
  /// Rounding may bring reflectances that add up to 1 this far above it.
  static constexpr double kRounding = 1e-6;
  /// As products might vanish, a triangle has no area unless twice its area exceeds this, m2.
  static constexpr double kSmallestArea = 1e-60;

  void checkArray(std::size_t number) const
  {
    vtkDataArray* array = arrays_[number];
    if (!array)
    {
      return;
    }
    const bool mayHaveThree = number != Exponent;
    const vtkIdType tuples = array->GetNumberOfTuples();
    const int components = array->GetNumberOfComponents();
    const vtkIdType cells = input_->GetNumberOfCells();
    const std::string has = joined(where_, ": the array ",
      array->GetName() ? array->GetName() : "(unnamed)", " (", kArrayMeanings[number], ") has ");
    const std::string shape = joined(
      "; in NumPy its shape is (", cells, ",)", mayHaveThree ? joined(" or (", cells, ", 3)") : "");
    throwIf(tuples != cells, has, tuples, " tuples for ", cells, " cells", shape);
    throwIf(components != 1 && !(mayHaveThree && components == 3), has, components, " components; ",
      mayHaveThree ? "1 or 3 are possible" : "1 is possible", shape,
      ", and append() repeats an array of any other length in each cell");
  }

  void makeRoom()
  {
    Material& material = target_.material;
    const auto bands = static_cast<std::size_t>(bands_);
    material.numberOfCells += static_cast<std::size_t>(input_->GetNumberOfCells());
    material.reflectance.resize(material.numberOfCells * bands, 0.0);
    if (arrays_[Exitance] || !target_.emission.exitance.empty())
    {
      target_.emission.exitance.resize(material.numberOfCells * bands, 0.0);
    }
    if (!target_.emission.luminaireOfCell.empty())
    {
      target_.emission.luminaireOfCell.resize(material.numberOfCells, Emission::kNone);
    }
    if (arrays_[Specular] || !target_.specular.empty())
    {
      target_.specular.resize(material.numberOfCells * bands, 0.0);
      target_.exponents.resize(material.numberOfCells, kInfinity);
    }
  }

  /// Calls visit(count, ids) for cells that are no ghosts.
  template <class Visit>
  void forEachOwnCell(vtkCellArray* cells, const Visit& visit)
  {
    forEachCell(cells, [&](vtkIdType count, const vtkIdType* ids) {
      pace_.step(static_cast<std::size_t>(count) + 1);
      if (!isGhost())
      {
        visit(count, ids);
      }
      ++cell_;
    });
  }

  void readPointLights()
  {
    forEachOwnCell(input_->GetVerts(), [this](vtkIdType count, const vtkIdType* ids) {
      noteLight(arrays_[Exitance], exitanceElsewhere_);
      if ((!arrays_[Flux] && !luminaire_) || count == 0)
      {
        return;
      }
      readPoints(count, ids);
      PointSource light{ Vector3::Zero(), {}, static_cast<std::uint32_t>(cellOfTarget()) };
      double total = 0;
      for (int band = 0; band < bands_; ++band)
      {
        const double flux = luminaire_
          ? luminaire_->flux[static_cast<std::size_t>(band)]
          : checked("radiant flux", value(arrays_[Flux], band), kBrightest, " W");
        light.flux.push_back(flux / static_cast<double>(count));
        total += flux;
      }
      for (std::size_t i = 0; total > 0 && i < corners_.size(); ++i)
      {
        light.position = corners_[i];
        target_.emission.points.push_back(light);
      }
    });
  }

  /// Lines have no surface, but may carry a flux or an exitance.
  void readLines()
  {
    forEachOwnCell(input_->GetLines(), [this](vtkIdType, const vtkIdType*) {
      noteLight(arrays_[Flux], fluxElsewhere_);
      noteLight(arrays_[Exitance], exitanceElsewhere_);
    });
  }

  /// `addTriangles` of the present corners.
  template <class AddTriangles>
  void readSurfaces(vtkCellArray* cells, const AddTriangles& addTriangles)
  {
    forEachOwnCell(cells, [&](vtkIdType count, const vtkIdType* ids) {
      readPoints(count, ids);
      const std::size_t first = target_.triangles.size();
      addTriangles();
      readSurfaceCell(first);
    });
  }

  /// Reads the arrays of a cell whose triangles have been added. Triangles without area are
  /// dropped, as they have no normal.
  void readSurfaceCell(std::size_t firstTriangle)
  {
    std::vector<Triangle>& triangles = target_.triangles;
    const auto isPoint = [](const Triangle& t) { return !(t.areaVector().norm() > kSmallestArea); };
    triangles.erase(std::remove_if(triangles.begin() + static_cast<std::ptrdiff_t>(firstTriangle),
                      triangles.end(), isPoint),
      triangles.end());
    double area = 0;
    for (std::size_t i = firstTriangle; i < triangles.size(); ++i)
    {
      target_.material.cellOfTriangle.push_back(static_cast<std::uint32_t>(cellOfTarget()));
      area += triangles[i].areaVector().norm();
    }
    if (!(area > 0))
    {
      note(withoutArea_);
    }
    noteLight(arrays_[Flux], fluxElsewhere_);
    readReflectance();
    for (int band = 0; arrays_[Exitance] && band < bands_; ++band)
    {
      target_.emission.exitance[slotOf(band)] =
        checked("radiant exitance", value(arrays_[Exitance], band), kBrightest, " W/m2");
    }
  }

  void readReflectance()
  {
    for (int band = 0; band < bands_; ++band)
    {
      const double diffuse = checked("diffuse reflectance",
        arrays_[Reflectance] ? value(arrays_[Reflectance], band) : defaultReflectance_, 1);
      target_.material.reflectance[slotOf(band)] = diffuse;
      if (arrays_[Specular])
      {
        const double specular = checked("specular reflectance", value(arrays_[Specular], band), 1);
        failIf(!(diffuse + specular <= 1 + kRounding), "diffuse reflectance ", diffuse,
          " and specular reflectance ", specular, " add up to more than 1");
        target_.specular[slotOf(band)] = std::min(specular, 1 - diffuse);
      }
    }
    if (arrays_[Exponent])
    {
      const double exponent = value(arrays_[Exponent], 0);
      failIf(!(exponent >= 0), "Phong exponent ", exponent, " is not 0 or more");
      if (!target_.specular.empty())
      {
        target_.exponents[cellOfTarget()] = exponent;
      }
    }
  }

  void readPoints(vtkIdType count, const vtkIdType* ids)
  {
    const vtkIdType points = input_->GetNumberOfPoints();
    corners_.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < corners_.size(); ++i)
    {
      failIf(ids[i] < 0 || ids[i] >= points, "refers to point ", ids[i], " of ", points);
      Vector3& point = corners_[i];
      input_->GetPoint(ids[i], point.data());
      if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() <= kMostDistant))
      {
        std::ostringstream message;
        message << "point " << ids[i]
                << (point.allFinite() ? " is out of range (" : " is not finite (")
                << point.transpose() << ")";
        failIf(true, message.str());
      }
    }
  }

  /// An input that gives light to cells of the wrong kind only is an error.
  void checkMisplaced() const
  {
    const bool hasSurface = input_->GetNumberOfPolys() + input_->GetNumberOfStrips() > 0;
    throwIf(fluxElsewhere_.cells > 0 && input_->GetNumberOfVerts() == 0, where_, ", cell ",
      fluxElsewhere_.firstCell,
      ": has a radiant flux but is no vertex; surfaces emit by their radiant exitance, W/m2");
    throwIf(exitanceElsewhere_.cells > 0 && !hasSurface, where_, ", cell ",
      exitanceElsewhere_.firstCell,
      ": has a radiant exitance but no surface; vertices emit by their radiant flux, W");
  }

  std::vector<InputWarning> warnings() const
  {
    std::vector<InputWarning> warnings{ withoutArea_, crossed_, fluxElsewhere_,
      exitanceElsewhere_ };
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                     [](const InputWarning& warning) { return warning.cells == 0; }),
      warnings.end());
    if (arrays_[Exponent] && !arrays_[Specular])
    {
      warnings.push_back(
        { where_, ": has Phong exponents but no specular reflectance; they are not read" });
    }
    return warnings;
  }

  /// Counts the cell being read.
  void note(InputWarning& odd) const { odd.firstCell = odd.cells++ == 0 ? cell_ : odd.firstCell; }
  /// Counts it if an array has a value above 0 there.
  void noteLight(vtkDataArray* array, InputWarning& odd) const
  {
    bool isLight = false;
    for (int band = 0; array && band < bands_; ++band)
    {
      isLight = isLight || value(array, band) > 0;
    }
    isLight ? note(odd) : void();
  }

  std::size_t cellOfTarget() const { return firstCell_ + static_cast<std::size_t>(cell_); }
  std::size_t slotOf(int band) const
  {
    return cellOfTarget() * static_cast<std::size_t>(bands_) + static_cast<std::size_t>(band);
  }

  bool isGhost() const
  {
    constexpr int kAbsent = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    return ghosts_ && (ghosts_->GetValue(cell_) & kAbsent) != 0;
  }

  double value(vtkDataArray* array, int band) const
  {
    return array->GetComponent(cell_, array->GetNumberOfComponents() == 1 ? 0 : band);
  }

  double checked(const char* name, double value, double most, const char* unit = "") const
  {
    failIf(!(value >= 0 && value <= most), name, " ", value, unit, " is not within 0..", most);
    return value;
  }

  template <class... Parts>
  void failIf(bool isWrong, const Parts&... parts) const
  {
    throwIf(isWrong, where_, ", cell ", cell_, ": ", parts...);
  }

  const std::string& where_;
  vtkPolyData* input_;
  const MaterialArrays<vtkDataArray>& arrays_;
  double defaultReflectance_;
  ConvertedPolyData& target_;
  const int bands_ = target_.material.bands;
  const std::size_t firstCell_ = target_.material.numberOfCells; ///< in the target
  vtkUnsignedCharArray* const ghosts_ = input_->GetCellGhostArray();
  ThrottledCancelPoint pace_;
  vtkIdType cell_ = 0; ///< the cell being read, by VTK's number
  std::optional<LuminaireFields> luminaire_;
  std::vector<Vector3> corners_;
  /// Each counts the cells that it is about.
  InputWarning withoutArea_{ where_, "have no area", "their irradiance is 0" };
  InputWarning crossed_{ where_, "are polygons that cross themselves",
    "what lies inside is not clear" };
  InputWarning fluxElsewhere_{ where_, "have a radiant flux but are no vertices",
    "it is not read there" };
  InputWarning exitanceElsewhere_{ where_, "have a radiant exitance but no surface",
    "it is not read there" };
};

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

std::vector<InputWarning> convertPolyData(const std::string& where, vtkPolyData* input,
  const MaterialArrays<vtkDataArray>& arrays, double defaultReflectance, ConvertedPolyData& target,
  const CancelPoint& cancelPoint)
{
  return PolyDataConverter(where, input, arrays, defaultReflectance, target, cancelPoint).convert();
}

}
