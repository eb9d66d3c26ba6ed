// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlainSource_h
#define PlainSource_h

#include "Rivals/PlainScene.h"

/// A triangle to draw points from: origin + s u + t v for 0 <= t <= s <= 1.
struct PlainPatch
{
  PlainScene::Vector origin; ///< the first corner
  PlainScene::Vector u, v;   ///< from the first corner to the second, from there to the third
  PlainScene::Vector normal; ///< to the front, of unit length
};

/// `offset`: m, that the patch is to lie off the triangle, on its front.
PlainPatch makePatch(const PlainScene::Triangle& triangle, float offset);

/// m2
double areaOf(const PlainPatch& patch);

/// Where light starts, a little off the surface. A point light is a patch without extent or normal.
struct PlainSource : PlainPatch
{
  float density; ///< 1/m2, of points drawn by flux from all lights; 0 of a point light
};

/// In the order of the lights, then of the point lights.
std::vector<PlainSource> makeSources(const PlainScene& scene);

/// In the same order, W. Throws std::invalid_argument if there is no light.
std::vector<double> fluxesOf(const PlainScene& scene);

#endif
