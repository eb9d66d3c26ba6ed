// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LuminaireFields_h
#define irradiance_LuminaireFields_h

#include "Sampling/DirectionTable.h"
#include "Surfaces/Emission.h"

#include "vtkType.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace irradiance
{

struct ConvertedPolyData;

/// The field-data arrays that make luminaires of the cells of a polydata, and its cell arrays that
/// tell how they stand. vtkLuminaireReader describes them.
class LuminaireFields
{
public:
  /// None, if it has no table of intensities. Throws InputError, naming `where`, the array and the
  /// value.
  static std::optional<LuminaireFields> of(const std::string& where, vtkPolyData* input, int bands);
  /// How many bands the flux has; 1 if there is none.
  static int bandsOf(vtkPolyData* input);

  /// W of each lamp, one per band.
  const std::vector<double>& flux() const { return flux_; }
  /// Makes luminaires of a part of the target: of each cell in which a point shines, and of the
  /// triangles from `firstTriangle` on, by their LampId.
  void addTo(ConvertedPolyData& target, std::size_t firstCell, std::size_t firstTriangle) const;

private:
  LuminaireFields() = default;
  /// With the axes of a cell.
  Luminaire lampOf(vtkIdType cell) const;
  Vector3 vectorOf(const char* name, vtkIdType cell, const Vector3& usual) const;
  int idOf(vtkIdType cell) const;
  /// Of an opening, whose faces are to be complete.
  void checkReach(const Luminaire& lamp, vtkIdType cell) const;
  [[noreturn]] void fail(vtkIdType cell, const std::string& what) const;

  std::string where_;
  vtkPolyData* input_ = nullptr;
  std::shared_ptr<const DirectionTable> intensity_;
  std::vector<double> flux_;
};

}

#endif
