// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Photon_h
#define irradiance_Photon_h

#include "Geometry/Ray.h"
#include "History/SegmentRef.h"

#include <array>
#include <vector>

namespace irradiance
{

/// A photon and where it arrived.
struct Photon
{
  SegmentRef reference;
  TriangleId id;
  std::array<float, 2> weights; ///< see Hit
  bool isFront;                 ///< the side that was hit
};

/// Photons that left the history or came to it, in any order.
struct PhotonChanges
{
  std::vector<Photon> gone, arrived;

  void add(const PhotonChanges& others)
  {
    gone.insert(gone.end(), others.gone.begin(), others.gone.end());
    arrived.insert(arrived.end(), others.arrived.begin(), others.arrived.end());
  }
};

}

#endif
