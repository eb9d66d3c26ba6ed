// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KeyFrameFile_h
#define irradiance_KeyFrameFile_h

#include "Geometry/KeyFrames.h"

#include <functional>
#include <string>
#include <vector>

namespace irradiance
{

/**
 * The key frames in a table of comma-separated values. The first line names the columns, in any
 * order and with or without quotes; others are passed over:
 * - `time`, and
 * - `x,y,z`, m, with or without a rotation: `rx,ry,rz`, degrees, about z first, then x, then y as
 *   with vtkProp3D, or the quaternion `qw,qx,qy,qz` of any length but 0; or
 * - `m00`, `m01`, ... `m33`: a matrix, row by row; the last row may be left out.
 *
 * Empty lines and lines that begin with # are skipped. Throws InputError, naming file, line, column
 * and value. `report` is called now and then with what was read of the file, 0..1; it may throw.
 */
std::vector<KeyFrame> readKeyFrames(
  const std::string& fileName, const std::function<void(double)>& report);

}

#endif
