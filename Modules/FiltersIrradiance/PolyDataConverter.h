#ifndef irradiance_PolyDataConverter_h
#define irradiance_PolyDataConverter_h

#include "Surface.h"

#include "vtkType.h"

#include <string>

class vtkCellArray;
class vtkDataArray;
class vtkPolyData;

namespace irradiance
{

/// The triangles of a polydata and what light does on its cells, which keep their order.
struct ConvertedPolyData
{
  std::vector<Triangle> triangles;
  Surface surface;
  vtkIdType cellsWithoutArea = 0; ///< of the polygons and strips
  vtkIdType firstCellWithoutArea = -1;
  vtkIdType crossedCells = 0; ///< polygons that cross themselves
  vtkIdType firstCrossedCell = -1;
};

/// The cell arrays that are read; each may be null. One or three components.
struct SurfaceArrays
{
  vtkDataArray* exitance = nullptr;
  vtkDataArray* reflectance = nullptr;
  vtkDataArray* flux = nullptr;
  double defaultReflectance = 0.5;
};

/// Reads one vtkPolyData. Throws InputError, naming `where` (as in "input port 1, connection 0"), the
/// cell and the value, for anything that cannot be computed.
class PolyDataConverter
{
public:
  PolyDataConverter(std::string where, vtkPolyData* input, const SurfaceArrays& arrays, int bands);

  ConvertedPolyData convert();

  /// Limits beyond which products of lengths, areas and powers might not be finite.
  static constexpr double kMostDistant = 1e30; ///< m
  static constexpr double kBrightest = 1e30;   ///< W/m2, W
  /// And vanish: what is not larger has no area, m2.
  static constexpr double kSmallestArea = 1e-60;

private:
  void checkArray(vtkDataArray* array, const char* meaning) const;
  void readPointLights(vtkCellArray* cells);
  void readPolygons(vtkCellArray* cells);
  void readStrips(vtkCellArray* cells);
  void readSurfaceCell();
  void readPoints(vtkIdType count, const vtkIdType* ids);
  double value(vtkDataArray* array, int band) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string where_;
  vtkPolyData* input_;
  SurfaceArrays arrays_;
  int bands_;
  ConvertedPolyData result_;
  vtkIdType cell_ = 0; ///< the cell that is read, counted as VTK does
  std::vector<Vector3> corners_;
  std::size_t firstTriangle_ = 0; ///< of the cell
};

}

#endif
