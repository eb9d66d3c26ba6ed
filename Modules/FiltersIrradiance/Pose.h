#ifndef irradiance_Pose_h
#define irradiance_Pose_h

#include "Vector.h"

#include <string>

class vtkLinearTransform;
class vtkPolyData;

namespace irradiance
{

/// The pose of a dynamic input: that of `transform`; if null, of the field-data array ObjectToWorld
/// (16 values, row by row); else the identity. Throws InputError, naming `where`, if it is not an
/// invertible affine map.
AffineMap poseOf(const std::string& where, vtkLinearTransform* transform, vtkPolyData* input);

}

#endif
