// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PolyDataConverter_h
#define irradiance_PolyDataConverter_h

#include "Geometry/Triangle.h"
#include "Input/InputWarning.h"
#include "Input/MaterialArrays.h"
#include "Progress/CancelPoint.h"
#include "Surfaces/Emission.h"
#include "Surfaces/Material.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace irradiance
{

/// The triangles of some polydata, and how its cells reflect and emit. These keep their order.
struct ConvertedPolyData
{
  explicit ConvertedPolyData(int bands)
  {
    material.bands = bands;
    emission.bands = bands;
  }

  /// For the cells of these inputs at once: growth by doubling would copy all, which takes long.
  void reserve(const std::vector<vtkPolyData*>& inputs);

  std::vector<Triangle> triangles;
  Material material;
  Emission emission;
  std::vector<double> specular; ///< of material.setSpecular(), once all is converted; empty: none
  std::vector<double> exponents;
};

/// Reads one vtkPolyData. Throws InputError, naming `where` (as in "input port 1, connection 0"),
/// the cell and the value, for anything that cannot be computed. Ghost cells that are duplicates or
/// hidden take no part.
class PolyDataConverter
{
public:
  /// Appends the input's cells to the cells of `target`, with the bands of `target`.
  PolyDataConverter(std::string where, vtkPolyData* input,
    const MaterialArrays<vtkDataArray>& arrays, double defaultReflectance,
    ConvertedPolyData& target, const CancelPoint& cancelPoint);

  std::vector<InputWarning> convert();

  /// Limits beyond which products of lengths, areas and powers might not be finite.
  static constexpr double kMostDistant = 1e30; ///< m
  static constexpr double kBrightest = 1e30;   ///< W/m2, W
  /// Rounding may bring reflectances that add up to 1 this far above it.
  static constexpr double kRounding = 1e-6;
  /// As such products might vanish, a triangle has no area unless twice its area exceeds this, m2.
  static constexpr double kSmallestArea = 1e-60;

private:
  /// Cells that deserve a warning: how many, and the first.
  struct OddCells
  {
    vtkIdType count = 0, first = -1;
    void add(vtkIdType cell) { first = count++ == 0 ? cell : first; }
  };

  void checkArray(std::size_t number) const;
  void makeRoom();
  void readPointLights(vtkCellArray* cells);
  void readLines();
  void readPolygons(vtkCellArray* cells);
  void readStrips(vtkCellArray* cells);
  void readSurfaceCell();
  void readReflectance(std::size_t cell);
  void readPoints(vtkIdType count, const vtkIdType* ids);
  double value(vtkDataArray* array, int band) const;
  bool isGhost() const;
  /// The largest value of an array in the cell, 0 if there is none.
  double largest(vtkDataArray* array) const;
  void checkMisplaced() const;
  std::vector<InputWarning> warnings() const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string where_;
  vtkPolyData* input_;
  MaterialArrays<vtkDataArray> arrays_;
  double defaultReflectance_;
  ConvertedPolyData& target_;
  int bands_;
  ThrottledCancelPoint pace_;
  vtkUnsignedCharArray* ghosts_;
  std::size_t firstCell_; ///< in the target
  vtkIdType cell_ = 0;    ///< the cell being read, by VTK's number
  std::vector<Vector3> corners_;
  std::size_t firstTriangle_ = 0; ///< of the cell
  OddCells withoutArea_;          ///< polygons and strips
  OddCells crossed_;              ///< polygons that cross themselves
  OddCells fluxElsewhere_;        ///< cells with a flux that are not vertices
  OddCells exitanceElsewhere_;    ///< vertices and lines with an exitance
};

}

#endif
