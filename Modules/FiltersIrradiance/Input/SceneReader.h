// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/InputConnection.h"
#include "Input/LampGroups.h"
#include "Input/PolyDataConverter.h"
#include "Surfaces/SceneObjects.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <optional>

namespace irradiance
{

/// Keeps the engine's scene in step with the inputs of the filter. What did not change keeps its
/// address, by which the engine recognizes it. An input is read when VTK says that it was modified,
/// and replaced only if its values differ. The triangles of a dynamic input whose pose mirrors are
/// turned over, so that the front of each is the mirror image of its front: elsewhere a triangle's
/// corners tell its front in the world, whatever the pose. A dynamic input without cells is an
/// object that is not there; it keeps its body, which may come back.
class SceneReader
{
public:
  /// All static parts make up object 0; each dynamic part is an object of its own, in order. Throws
  /// InputError. Afterwards objects() is the scene; after an exception it is what it was, or partly
  /// new.
  void read(const SceneInputs& inputs, double defaultReflectance, const CancelPoint& cancelPoint);

  const SceneObjects& objects() const { return objects_; }
  int bands() const { return bands_; }
  /// By number, see Emission::groups.
  const std::vector<LampGroup>& lampGroups() const { return lampGroups_.groups(); }
  std::uint32_t groupOfSky() const { return groupOfSky_; }
  /// What bands() is after reading these: 3 if an array has three components, else 1.
  static int countBands(const SceneInputs& inputs);
  /// How many parts are static.
  std::size_t numberOfStatics() const { return firstCells().size(); }
  /// The first cell of a part, by its number among all: the static ones, then the dynamic ones.
  SceneCell firstCellOf(std::size_t part) const;
  /// To which of these a cell belongs.
  std::size_t partOf(const SceneCell& cell) const;
  /// What messages call a cell, as in "input port 0, connection 1, cell 3". The inputs are what was
  /// read.
  std::string nameOf(const SceneCell& cell, const SceneInputs& inputs) const;
  /// New warnings since the last call, about inputs that can be computed all the same.
  std::vector<std::string> takeWarnings() { return warnings_.take(); }
  /// Whether anything but poses has changed since forgetNews(): cells, materials, parts that are
  /// there.
  bool hasNews() const { return hasNews_; }
  void forgetNews() { hasNews_ = false; }
  /// Whether there is a sky, or a sun, be it night.
  bool isUnderSky() const { return isUnderSky_; }

private:
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

  static Stamp stampOf(const InputPart& part);
  const std::vector<std::size_t>& firstCells() const
  {
    return objects_.staticObject.material->firstCellOfPart;
  }
  void convert(const InputPart& part, ConvertedPolyData& target, const CancelPoint& cancelPoint);
  void readStatic(const std::vector<const InputPart*>& parts, const CancelPoint& cancelPoint);
  void adoptSky(const std::vector<const InputPart*>& parts);
  void readDynamic(const InputPart& part, std::size_t index, const CancelPoint& cancelPoint);
  void adopt(
    ConvertedPolyData data, SceneObject& object, bool mayMove, const CancelPoint& cancelPoint);

  int bands_ = 1;
  double defaultReflectance_ = 0.5;
  std::optional<std::vector<Stamp>> staticStamps_; ///< none: to be read
  std::vector<std::optional<Stamp>> dynamicStamps_;
  SceneObjects objects_;
  LampGroups lampGroups_;
  std::uint32_t groupOfSky_ = 0;
  InputWarnings warnings_;
  bool hasNews_ = false, isUnderSky_ = false;
};

}
