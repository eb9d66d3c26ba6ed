// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/LightTable.h"
#include "Surfaces/SceneObjects.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Where light arrives that comes straight from the lights of a table, by a few rays from each.
 *
 * It depends on the lights and on the static object alone, so that no motion of others changes it.
 */
class FirstHits
{
public:
  FirstHits(const SceneObjects& objects, const LightTable& lights);

  /// A ray from a light that meets a static triangle.
  struct Arrival
  {
    std::uint32_t light, triangle;
    bool isFront;       ///< which side of it
    std::uint32_t half; ///< 0 or 1: every other ray of a light, which knows nothing of the rest
    double flux;        ///< W
  };
  const std::vector<Arrival>& arrivals() const { return arrivals_; }
  /// Which lights shine mostly on static triangles so near to them that what arrives differs much
  /// from place to place: a strip along a wall, a lamp just over the floor. There walks that start
  /// at the light find the light of a cell with less work than samples of the cell do.
  const std::vector<bool>& nearLights() const { return nearLights_; }
  /// Which lights are about as bright as what the scene sends that they light: warm walls of an
  /// oven, a room that shines everywhere. Light from everywhere is found by any ray, and cells that
  /// looked for it would choose among thousands of lights that bring little each. So walks start at
  /// them, and rays of a final gather count what they emit. What the lights light themselves
  /// counts: to rays a lamp in a hut is bright, however strong the sun is outside. `lights`: of the
  /// table. `reflected`: the mean part of static cells.
  std::vector<bool> dimLights(
    const SceneObjects& objects, const LightTable& lights, double reflected) const;
  /// The part of what arrives at static triangles that they reflect and that arrives at some again,
  /// 0..1; 1 if hardly anything arrives. Roughly: a standard error of 0.1 at most.
  double returned() const { return returned_; }
  /// W that arrive at static triangles, and what these reflect of it.
  double arrived() const { return arrived_; }
  double reflected() const { return reflected_; }
  /// W2/m2: the integral over the area of the square of what static cells reflect for their area. A
  /// relative standard error of 0.1, roughly.
  double reflectedSquares() const { return reflectedSquares_; }
  /// m2, of the static object.
  double area() const { return area_; }

private:
  /// Of the arrivals.
  void sumUp(const SceneObject& object);
  std::vector<Arrival> arrivals_; ///< by light
  std::vector<bool> nearLights_;
  double returned_ = 1, arrived_ = 0, reflected_ = 0, reflectedSquares_ = 0, area_ = 0;
};

}
