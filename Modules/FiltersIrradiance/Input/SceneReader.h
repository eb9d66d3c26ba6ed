// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneReader_h
#define irradiance_SceneReader_h

#include "Input/InputConnection.h"
#include "Input/PolyDataConverter.h"
#include "Surfaces/SceneObjects.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <optional>

namespace irradiance
{

/**
 * Keeps the engine's scene in step with the inputs of the filter. What did not change keeps its
 * address, by which the engine recognizes it. An input is read when VTK says that it was modified,
 * and replaced only if its values differ. The triangles of a dynamic input whose pose mirrors are
 * turned over, so that the front of each is the mirror image of its front: elsewhere a triangle's
 * corners tell its front in the world, whatever the pose. A dynamic input without cells is an
 * object that is not there; it keeps its body, which may come back.
 */
class SceneReader
{
public:
  /// All parts of the static connections make up object 0; each part of the dynamic ones is an
  /// object of its own, in order. Throws InputError. Afterwards objects() is the scene; after an
  /// exception it is what it was, or partly new.
  void read(const std::vector<InputConnection>& staticConnections,
    const std::vector<InputConnection>& dynamicConnections, double defaultReflectance,
    const CancelPoint& cancelPoint);

  const SceneObjects& objects() const { return objects_; }
  int bands() const { return settings_.bands; }
  /// What bands() is after reading these: 3 if an array has three components, else 1.
  static int countBands(const std::vector<InputConnection>& staticConnections,
    const std::vector<InputConnection>& dynamicConnections);
  /// Number of the first cell of a static part among the cells of object 0.
  std::size_t firstCellOfStatic(std::size_t part) const { return firstCell_[part]; }
  /// What messages call a cell, as in "input port 0, connection 1, cell 3". The connections are
  /// those that were read.
  std::string nameOf(const SceneCell& cell, const std::vector<InputConnection>& staticConnections,
    const std::vector<InputConnection>& dynamicConnections) const;
  /// New warnings since the last call, about inputs that can be computed all the same.
  std::vector<std::string> takeWarnings() { return warnings_.take(); }
  /// Whether anything but poses has changed since forgetNews(): cells, materials, parts that are
  /// there.
  bool hasNews() const { return hasNews_; }
  void forgetNews() { hasNews_ = false; }

private:
  struct Settings
  {
    int bands = 1;
    double defaultReflectance = 0.5;
    bool operator!=(const Settings& other) const
    {
      return bands != other.bands || defaultReflectance != other.defaultReflectance;
    }
  };

  /// An input as it was when it was read. The polydata is held so that its address is not reused.
  struct Stamp
  {
    vtkSmartPointer<vtkPolyData> polyData;
    MaterialArrays<vtkAbstractArray> arrays; ///< those chosen; never dereferenced
    vtkMTimeType time;
    bool isMirrored;
    bool operator==(const Stamp& other) const
    {
      return polyData == other.polyData && arrays == other.arrays && time == other.time &&
        isMirrored == other.isMirrored;
    }
  };

  using Parts = std::vector<const InputPart*>;

  static Parts partsOf(const std::vector<InputConnection>& connections);
  static Stamp stampOf(const InputPart& part);
  void convert(const InputPart& part, ConvertedPolyData& target, const CancelPoint& cancelPoint);
  void readStatic(const Parts& parts, const CancelPoint& cancelPoint);
  void readDynamic(const InputPart& part, std::size_t index, const CancelPoint& cancelPoint);
  void adopt(
    ConvertedPolyData data, SceneObject& object, bool mayMove, const CancelPoint& cancelPoint);

  Settings settings_;
  std::optional<std::vector<Stamp>> staticStamps_; ///< none: to be read
  std::vector<std::optional<Stamp>> dynamicStamps_;
  SceneObjects objects_;
  std::vector<std::size_t> firstCell_;
  InputWarnings warnings_;
  bool hasNews_ = false;
};

}

#endif
