// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Input/ChosenArrays.h"
#include "Input/PartCells.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataObject;
class vtkFieldData;
class vtkLinearTransform;
class vtkPolyData;

namespace irradiance
{

/// About an input that can be computed all the same.
struct InputWarning
{
  std::string input; ///< its name
  std::string what;  ///< follows the name, the same for all such inputs
  /// If it is about some of its cells: `what` follows their number, and this their first.
  std::string consequence{};
  vtkIdType cells = 0, firstCell = -1;
};

/// One polydata of the scene: the data of a connection, or a leaf of a composite one.
struct InputPart
{
  std::string name; ///< as in "input port 1, connection 0" or "..., block 3 (Plate)"
  vtkPolyData* polyData = nullptr;
  vtkPolyData* piece = nullptr; ///< what this process has of it: all, unless inputs are distributed
  PieceCells cells;             ///< of the piece
  MaterialArrays<vtkAbstractArray> arrays{};
  vtkFieldData* connectionFields = nullptr; ///< if the connection has others than the part
  std::string lampGroup;                    ///< of its lamps, if nobody says another
  AffineMap worldFromPart;                  ///< the identity for static parts
  const char* innerPose = nullptr;          ///< a field-data array that is part of that; or null
  std::vector<InputWarning> warnings;
};

/// A connection of the filter and the polydata in it, in the order of its leaves.
struct InputConnection
{
  std::string name; ///< as in "input port 1, connection 0"
  vtkDataObject* data = nullptr;
  std::vector<InputPart> parts;
};

/// What the filter's input ports have: port 0 what is static, port 1 what is dynamic.
struct SceneInputs
{
  std::vector<InputConnection> statics, dynamics;
};

/// The parts of connections, in order.
template <class Connections>
auto partsOf(Connections& connections)
{
  std::vector<decltype(connections.front().parts.data())> parts;
  for (auto& connection : connections)
  {
    for (auto& part : connection.parts)
    {
      parts.push_back(&part);
    }
  }
  return parts;
}

/// All parts: the static ones, then the dynamic ones.
template <class Inputs>
auto allPartsOf(Inputs& inputs)
{
  auto parts = partsOf(inputs.statics);
  const auto dynamics = partsOf(inputs.dynamics);
  parts.insert(parts.end(), dynamics.begin(), dynamics.end());
  return parts;
}

/// The group of lamps that are static, if nobody says another.
constexpr const char* kStaticLampGroup = "Static";

/// A static connection. Throws InputError for a leaf that is no polydata.
InputConnection staticConnection(vtkAlgorithm* filter, int index, vtkDataObject* data);

/// A dynamic connection. `transform` is its pose; if null, the field-data array ObjectToWorld of
/// `data`; else the identity. In composite data, a leaf with such an array of its own is moved by
/// that first, then by the pose of the connection. Before all that a part is moved by its
/// field-data array `innerPose` (null: none). Also throws InputError for a pose that is not an
/// invertible affine map, and if some parts with cells have an `innerPose` and others do not.
InputConnection dynamicConnection(vtkAlgorithm* filter, int index, vtkDataObject* data,
  vtkLinearTransform* transform, const char* innerPose);

/// Notes in `output` that it shares the points, cells and arrays of `input`, so that a reader who
/// knows `input` need not read `output`, which is newer in each time step. Copies do not have the
/// note.
void notePassedGeometry(vtkPolyData* output, vtkPolyData* input);

/// The polydata from which the geometry was passed on, through several filters perhaps; `polyData`
/// itself if there is no note.
vtkPolyData* originOfGeometry(vtkPolyData* polyData);

/// Says once what is the same for many inputs, naming the first and how many there are.
class InputWarnings
{
public:
  /// Of an input that is read again, the same warning counts once.
  void add(const InputWarning& warning);
  /// A text for each kind of warning since the last call.
  std::vector<std::string> take();

private:
  /// The first of each kind, and how many cells it is about, by input.
  std::vector<std::pair<InputWarning, std::map<std::string, vtkIdType>>> kinds_;
};

}
