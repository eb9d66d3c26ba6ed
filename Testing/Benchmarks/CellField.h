#ifndef CellField_h
#define CellField_h

#include "IrradianceEngine.h"

#include <vector>

/// A value for each cell of a scene, object after object.
using CellField = std::vector<double>;

/// m2, in the world.
CellField areasOf(const irradiance::SceneObjects& objects);
/// W/m2 in the first band.
CellField irradianceOf(
  const irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects);
/// Standard errors of these; NaN where unknown.
CellField standardErrorOf(
  const irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects);

/// The mean over the area.
double meanOf(const CellField& field, const CellField& areas);
/// The root of the mean square difference over the area, in units of the truth's mean.
double rmsError(const CellField& field, const CellField& truth, const CellField& areas);
/// The largest difference in any cell, in units of the truth's mean.
double worstError(const CellField& field, const CellField& truth, const CellField& areas);
/// From cells cut into four to the cells they were cut from: the pieces have the same area.
CellField coarsened(const CellField& field, int levels);
/// The least value that a share of the area does not exceed.
double quantileOf(const CellField& field, const CellField& areas, double share);

#endif
