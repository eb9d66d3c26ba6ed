// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonShares_h
#define irradiance_PhotonShares_h

#include "Surfaces/SceneCell.h"

#include <optional>

namespace irradiance
{

/// What knows on how many photons estimates of cells draw that are not the cells' own sums.
class PhotonShares
{
public:
  virtual ~PhotonShares() = default;
  /// A photon's effective part in the estimate of a cell, 0..1: the estimate draws on 1 / this for
  /// each photon that the cell expects.
  virtual double photonShare(const CellSide& cell) const = 0;
  /// The variance of its estimate that comes of the rays of the cell, quanta^2; nothing if it casts
  /// none.
  virtual std::optional<double> rayVariance(const CellSide& /*cell*/, int /*band*/) const
  {
    return {};
  }

protected:
  PhotonShares() = default;
  PhotonShares(const PhotonShares&) = default;
  PhotonShares& operator=(const PhotonShares&) = default;
};

}

#endif
