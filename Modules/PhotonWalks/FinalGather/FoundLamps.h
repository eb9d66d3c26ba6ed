// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FoundLamps_h
#define irradiance_FoundLamps_h

#include "Walks/WalkSets.h"

#include <vector>

namespace irradiance
{

/// The cells whose emission rays count where they meet it, as nobody looks for it: see DimLights.
class FoundLamps
{
public:
  FoundLamps(const WalkSets& walks, const CellNumbers& cells)
    : cells_(cells)
  {
    for (const WalkSet& set : walks.sets())
    {
      for (const Light& light : set.source().areFoundByRays ? set.lights().lights() : none_)
      {
        areFound_.resize(cells.size());
        areFound_[cells[light.cell]] = true;
      }
    }
  }

  bool isEmpty() const { return areFound_.empty(); }
  /// Not if it is empty.
  bool contains(const SceneCell& cell) const { return areFound_[cells_[cell]]; }

private:
  const CellNumbers& cells_;
  const std::vector<Light> none_;
  std::vector<bool> areFound_; ///< by cell; empty: none
};

}

#endif
