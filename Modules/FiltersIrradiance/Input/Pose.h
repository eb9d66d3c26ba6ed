// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>

class vtkFieldData;
class vtkLinearTransform;

namespace irradiance
{

/// The field-data array that holds a pose: 16 values, row by row.
constexpr const char* kFieldPoseName = "ObjectToWorld";

/// A transform's pose. Throws InputError, naming `where`, if it is not an invertible affine map.
AffineMap poseOf(const std::string& where, vtkLinearTransform* transform);

/// The pose of 16 values, row by row. Throws InputError likewise.
AffineMap poseOf(const std::string& where, const double* rowByRow);

/// The matrix of a vtkProp3D at this place, turned by these degrees: about z first, then x, then y.
/// Row by row.
std::array<double, 16> propMatrix(const double position[3], const double orientation[3]);

/// The pose in an array of the field data; the identity if there is none. Also throws InputError
/// for an array that does not hold 16 numbers.
AffineMap poseOf(
  const std::string& where, vtkFieldData* fields, const char* arrayName = kFieldPoseName);

/// Whether the field data hold anything but the identity as a pose.
bool hasFieldPose(vtkFieldData* fields);

/// The transform with these elements, row by row; with the bits of all of them.
vtkSmartPointer<vtkLinearTransform> transformOf(const double elements[16]);

/// The matrix of a map, row by row.
std::array<double, 16> matrixOf(const AffineMap& map);
/// Returns `map`. Throws InputError, naming `where`, if it is not invertible.
AffineMap checkedPose(const std::string& where, const AffineMap& map);
/// First `inner`, then `outer`. If one is the identity, the result has the bits of the other.
AffineMap composed(const AffineMap& outer, const AffineMap& inner);

}
