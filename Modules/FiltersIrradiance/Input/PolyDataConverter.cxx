// SPDX-License-Identifier: BSD-3-Clause
#include "Input/PolyDataConverter.h"

#include "Input/LuminaireFields.h"
#include "Input/PartCells.h"
#include "Meshes/PolygonTriangulation.h"
#include "Progress/InputError.h"

#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace irradiance
{

namespace
{

struct PolyDataConverter
{
  /// Limit beyond which products of powers might not be finite, W/m2, W.
  static constexpr double kBrightest = 1e30;
  /// Rounding may bring reflectances that add up to 1 this far above it.
  static constexpr double kRounding = 1e-6;
  /// As products might vanish, a triangle has no area unless twice its area exceeds this, m2.
  static constexpr double kSmallestArea = 1e-60;

  const std::string& where;
  vtkPolyData* input;
  const MaterialArrays<vtkDataArray>& arrays;
  double defaultReflectance;
  ConvertedPolyData& target;
  const CancelPoint& cancelPoint;

  ThrottledCancelPoint pace{ cancelPoint };
  const int bands = target.material.bands;
  const std::size_t firstCell = target.material.numberOfCells; ///< in the target
  vtkUnsignedCharArray* const ghosts = input->GetCellGhostArray();
  vtkIdType cell = 0; ///< the cell being read, by VTK's number
  std::optional<LuminaireFields> luminaire{};
  std::vector<Vector3> corners{};
  /// Each counts the cells that it is about.
  InputWarning withoutArea{ where, "have no area", "their irradiance is 0" };
  InputWarning crossed{ where, "are polygons that cross themselves",
    "what lies inside is not clear" };
  InputWarning fluxElsewhere{ where, "have a radiant flux but are no vertices",
    "it is not read there" };
  InputWarning exitanceElsewhere{ where, "have a radiant exitance but no surface",
    "it is not read there" };

  std::vector<InputWarning> convert()
  {
    for (std::size_t number = 0; number < arrays.size(); ++number)
    {
      checkArray(number);
    }
    for (vtkCellArray* cells :
      { input->GetVerts(), input->GetLines(), input->GetPolys(), input->GetStrips() })
    {
      throwIf(!cells->IsValid(), where, ": the offsets of a cell array are not valid");
    }
    luminaire = readLuminaires(where, input, bands);
    for (const MaterialArray light : { Exitance, Flux })
    {
      throwIf(luminaire && arrays[light], where, ": has a table of radiant intensity and a ",
        kArrayMeanings[light], "; only one of them can give its light");
    }
    makeRoom();
    const std::size_t firstTriangle = target.triangles.size();
    readPointLights();
    readLines();
    readSurfaces(input->GetPolys(), [this] {
      if (!triangulate(corners, target.triangles))
      {
        note(crossed);
      }
    });
    readSurfaces(input->GetStrips(), [this] {
      for (std::size_t i = 0; i + 2 < corners.size(); ++i)
      {
        // Every other triangle of a strip has the opposite orientation.
        const std::size_t odd = i % 2;
        target.triangles.push_back({ corners[i], corners[i + 1 + odd], corners[i + 2 - odd] });
      }
    });
    checkMisplaced();
    if (luminaire)
    {
      addLuminaires(*luminaire, firstCell, firstTriangle, target);
    }
    return warnings();
  }

  void checkArray(std::size_t number) const
  {
    vtkDataArray* array = arrays[number];
    if (!array)
    {
      return;
    }
    const bool mayHaveThree = number != Exponent && number != Index;
    const vtkIdType tuples = array->GetNumberOfTuples();
    const int components = array->GetNumberOfComponents();
    const vtkIdType cells = input->GetNumberOfCells();
    const std::string has = joined(where, ": the array ",
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
    Material& material = target.material;
    material.numberOfCells += static_cast<std::size_t>(input->GetNumberOfCells());
    const std::size_t slots = material.numberOfCells * static_cast<std::size_t>(bands);
    material.reflectance.resize(slots, 0.0);
    if (arrays[Exitance] || !target.emission.exitance.empty())
    {
      target.emission.exitance.resize(slots, 0.0);
    }
    if (!target.emission.luminaireOfCell.empty())
    {
      target.emission.luminaireOfCell.resize(material.numberOfCells, Emission::kNone);
    }
    if (arrays[Specular] || !target.specular.empty())
    {
      target.specular.resize(slots, 0.0);
      target.exponents.resize(material.numberOfCells, kInfinity);
    }
    const auto resizeIf = [&](MaterialArray array, std::vector<double>& values, double absent) {
      if (arrays[array] || !values.empty())
      {
        values.resize(array == Index ? material.numberOfCells : slots, absent);
      }
    };
    resizeIf(DiffuseThrough, target.diffuseThrough, 0);
    resizeIf(Straight, target.straight, 0);
    resizeIf(Index, target.index, 1);
    resizeIf(Internal, target.internal, 1);
  }

  /// Calls visit(count, ids) for cells that are no ghosts.
  template <class Visit>
  void forEachOwnCell(vtkCellArray* cells, const Visit& visit)
  {
    forEachCell(cells, [&](vtkIdType count, const vtkIdType* ids) {
      pace.step(static_cast<std::size_t>(count) + 1);
      if (!isGhost())
      {
        visit(count, ids);
      }
      ++cell;
    });
  }

  void readPointLights()
  {
    forEachOwnCell(input->GetVerts(), [this](vtkIdType count, const vtkIdType* ids) {
      noteLight(arrays[Exitance], exitanceElsewhere);
      if ((!arrays[Flux] && !luminaire) || count == 0)
      {
        return;
      }
      readPoints(count, ids);
      PointSource light{ Vector3::Zero(), {}, static_cast<std::uint32_t>(cellOfTarget()) };
      double total = 0;
      for (int band = 0; band < bands; ++band)
      {
        const double flux = luminaire
          ? luminaire->flux[static_cast<std::size_t>(band)]
          : checked("radiant flux", value(arrays[Flux], band), kBrightest, " W");
        light.flux.push_back(flux / static_cast<double>(count));
        total += flux;
      }
      for (std::size_t i = 0; total > 0 && i < corners.size(); ++i)
      {
        light.position = corners[i];
        target.emission.points.push_back(light);
      }
    });
  }

  /// Lines have no surface, but may carry a flux or an exitance.
  void readLines()
  {
    forEachOwnCell(input->GetLines(), [this](vtkIdType, const vtkIdType*) {
      noteLight(arrays[Flux], fluxElsewhere);
      noteLight(arrays[Exitance], exitanceElsewhere);
    });
  }

  /// `addTriangles` of the present corners.
  template <class AddTriangles>
  void readSurfaces(vtkCellArray* cells, const AddTriangles& addTriangles)
  {
    forEachOwnCell(cells, [&](vtkIdType count, const vtkIdType* ids) {
      readPoints(count, ids);
      const std::size_t first = target.triangles.size();
      addTriangles();
      readSurfaceCell(first);
    });
  }

  /// Reads the arrays of a cell whose triangles have been added. Triangles without area are
  /// dropped, as they have no normal.
  void readSurfaceCell(std::size_t firstTriangle)
  {
    std::vector<Triangle>& triangles = target.triangles;
    const auto isPoint = [](const Triangle& t) { return !(t.areaVector().norm() > kSmallestArea); };
    triangles.erase(std::remove_if(triangles.begin() + static_cast<std::ptrdiff_t>(firstTriangle),
                      triangles.end(), isPoint),
      triangles.end());
    double area = 0;
    for (std::size_t i = firstTriangle; i < triangles.size(); ++i)
    {
      target.material.cellOfTriangle.push_back(static_cast<std::uint32_t>(cellOfTarget()));
      area += triangles[i].areaVector().norm();
    }
    if (!(area > 0))
    {
      note(withoutArea);
    }
    noteLight(arrays[Flux], fluxElsewhere);
    readReflectance();
    for (int band = 0; arrays[Exitance] && band < bands; ++band)
    {
      target.emission.exitance[slotOf(band)] =
        checked("radiant exitance", value(arrays[Exitance], band), kBrightest, " W/m2");
    }
  }

  /// For the user.
  std::string partsOf(int band) const
  {
    std::string parts = joined("diffuse reflectance ", target.material.reflectance[slotOf(band)]);
    for (const MaterialArray array : { Specular, DiffuseThrough, Straight })
    {
      parts += arrays[array]
        ? joined(" and ", kArrayMeanings[array], " ", value(arrays[array], band))
        : std::string();
    }
    return parts;
  }

  void readReflectance()
  {
    const double index = arrays[Index] ? value(arrays[Index], 0) : 1;
    failIf(!(index >= 1 && std::isfinite(index)), "refractive index ", index, " is not 1 or more");
    for (int band = 0; band < bands; ++band)
    {
      const double diffuse = checked("diffuse reflectance",
        arrays[Reflectance] ? value(arrays[Reflectance], band) : defaultReflectance, 1);
      target.material.reflectance[slotOf(band)] = diffuse;
      double sum = diffuse;
      for (const auto& [array, values] :
        { std::pair(Specular, &target.specular), std::pair(DiffuseThrough, &target.diffuseThrough),
          std::pair(Straight, &target.straight) })
      {
        if (arrays[array])
        {
          const double part = checked(kArrayMeanings[array], value(arrays[array], band), 1);
          (*values)[slotOf(band)] = std::min(part, std::max(0.0, 1 - sum));
          sum += part;
        }
      }
      if (!(sum <= 1 + kRounding) && index == 1) // a pane has none of these
      {
        failIf(true, partsOf(band), " add up to more than 1");
      }
    }
    if (arrays[Index])
    {
      target.index[cellOfTarget()] = index;
    }
    for (int band = 0; arrays[Internal] && band < bands; ++band)
    {
      const double internal = value(arrays[Internal], band);
      failIf(!(internal > 0 && internal <= 1), "internal transmittance ", internal,
        " is not above 0 and at most 1");
      target.internal[slotOf(band)] = internal;
    }
    if (arrays[Exponent])
    {
      const double exponent = value(arrays[Exponent], 0);
      failIf(!(exponent >= 0), "Phong exponent ", exponent, " is not 0 or more");
      if (!target.specular.empty())
      {
        target.exponents[cellOfTarget()] = exponent;
      }
    }
  }

  void readPoints(vtkIdType count, const vtkIdType* ids)
  {
    const vtkIdType points = input->GetNumberOfPoints();
    corners.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      failIf(ids[i] < 0 || ids[i] >= points, "refers to point ", ids[i], " of ", points);
      Vector3& point = corners[i];
      input->GetPoint(ids[i], point.data());
      if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() <= kMostDistant))
      {
        std::ostringstream place; // with six digits, as points are floats mostly
        place << point.transpose();
        failIf(true, "point ", ids[i],
          point.allFinite() ? " is out of range (" : " is not finite (", place.str(), ")");
      }
    }
  }

  /// An input that gives light to cells of the wrong kind only is an error.
  void checkMisplaced() const
  {
    const bool hasSurface = input->GetNumberOfPolys() + input->GetNumberOfStrips() > 0;
    throwIf(fluxElsewhere.cells > 0 && input->GetNumberOfVerts() == 0, where, ", cell ",
      fluxElsewhere.firstCell,
      ": has a radiant flux but is no vertex; surfaces emit by their radiant exitance, W/m2");
    throwIf(exitanceElsewhere.cells > 0 && !hasSurface, where, ", cell ",
      exitanceElsewhere.firstCell,
      ": has a radiant exitance but no surface; vertices emit by their radiant flux, W");
  }

  std::vector<InputWarning> warnings() const
  {
    std::vector<InputWarning> warnings{ withoutArea, crossed, fluxElsewhere, exitanceElsewhere };
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                     [](const InputWarning& warning) { return warning.cells == 0; }),
      warnings.end());
    if (arrays[Exponent] && !arrays[Specular])
    {
      warnings.push_back(
        { where, ": has Phong exponents but no specular reflectance; they are not read" });
    }
    if (arrays[Internal] && !arrays[Index])
    {
      warnings.push_back(
        { where, ": has internal transmittances but no refractive index; they are not read" });
    }
    return warnings;
  }

  /// Counts the cell being read.
  void note(InputWarning& odd) const { odd.firstCell = odd.cells++ == 0 ? cell : odd.firstCell; }
  /// Counts it if an array has a value above 0 there.
  void noteLight(vtkDataArray* array, InputWarning& odd) const
  {
    bool isLight = false;
    for (int band = 0; array && band < bands; ++band)
    {
      isLight = isLight || value(array, band) > 0;
    }
    isLight ? note(odd) : void();
  }

  std::size_t cellOfTarget() const { return firstCell + static_cast<std::size_t>(cell); }
  std::size_t slotOf(int band) const
  {
    return cellOfTarget() * static_cast<std::size_t>(bands) + static_cast<std::size_t>(band);
  }

  bool isGhost() const
  {
    constexpr int kAbsent = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    return ghosts && (ghosts->GetValue(cell) & kAbsent) != 0;
  }

  double value(vtkDataArray* array, int band) const
  {
    return array->GetComponent(cell, array->GetNumberOfComponents() == 1 ? 0 : band);
  }

  double checked(const char* name, double value, double most, const char* unit = "") const
  {
    failIf(!(value >= 0 && value <= most), name, " ", value, unit, " is not within 0..", most);
    return value;
  }

  template <class... Parts>
  void failIf(bool isWrong, const Parts&... parts) const
  {
    throwIf(isWrong, where, ", cell ", cell, ": ", parts...);
  }
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
  return PolyDataConverter{ where, input, arrays, defaultReflectance, target, cancelPoint }
    .convert();
}

}
