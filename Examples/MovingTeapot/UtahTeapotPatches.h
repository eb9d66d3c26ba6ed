// SPDX-License-Identifier: BSD-3-Clause
/**
 * The Utah teapot as it is published: 32 bicubic Bezier patches over 306 control points.
 *
 * Martin Newell, "The Utilization of Procedure Models in Digital Image Synthesis", PhD thesis,
 * University of Utah, 1975, with the lesser height that Jim Blinn gave it and Frank Crow's bottom
 * ("The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987). The numbers
 * are those of the data set that has gone from hand to hand since (the "teaset" archive; also in
 * freeglut, RenderMan's and K-3D's teapot). The points 205, 206, 216 and 223 belong to no patch.
 *
 * Lengths have no unit, z is up, the bottom is at 0, the spout looks along +x.
 */
#ifndef UtahTeapotPatches_h
#define UtahTeapotPatches_h

#include <array>

namespace movingteapot
{

/** x, y, z. */
extern const std::array<std::array<double, 3>, 306> TeapotControlPoints;

/** Per patch 4 x 4 control points, row after row, counted from 1 as in the publication. */
extern const std::array<std::array<int, 16>, 32> TeapotPatches;

}

#endif
