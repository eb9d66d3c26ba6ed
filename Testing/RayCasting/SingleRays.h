// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_SingleRays_h
#define irradiance_test_SingleRays_h

#include "Scene/Scene.h"

/// Casts of one ray by what a scene does for many.
namespace irradiance::test
{

inline Hit castStatic(const Scene& scene, const Ray& ray, Hit best, double from = 0)
{
  scene.castStatic(&ray, 1, &best, &from);
  return best;
}

inline Hit castDynamic(const Scene& scene, const Ray& ray, Hit best)
{
  scene.castDynamic(&ray, 1, &best);
  return best;
}

inline Hit castMoved(const Scene& scene, const Ray& ray, Hit best)
{
  scene.castMoved(&ray, 1, &best);
  return best;
}

}

#endif
