// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Pose_h
#define irradiance_Pose_h

#include "Geometry/Vector.h"

#include <string>

class vtkFieldData;
class vtkLinearTransform;

namespace irradiance
{

/// The field-data array that holds a pose: 16 values, row by row.
constexpr const char* kFieldPoseName = "ObjectToWorld";

/// The pose of a transform. Throws InputError, naming `where`, if it is not an invertible affine map.
AffineMap poseOf(const std::string& where, vtkLinearTransform* transform);

/// The pose in the field data; the identity if there is none. Throws InputError also for an array
/// that does not hold 16 numbers.
AffineMap poseOf(const std::string& where, vtkFieldData* fields);

/// Whether the field data hold anything else than the identity as a pose.
bool hasFieldPose(vtkFieldData* fields);

/// The same map. Throws InputError, naming `where`, if it is not invertible.
AffineMap checkedPose(const std::string& where, const AffineMap& map);

/// First `inner`, then `outer`; a factor that is the identity leaves the other's bits.
AffineMap composed(const AffineMap& outer, const AffineMap& inner);

}

#endif
