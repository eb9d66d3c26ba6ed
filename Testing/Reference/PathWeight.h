// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"

#include <functional>

namespace pathtracedroom
{

/**
 * A path of n vertices can come about in up to n + 1 ways: s vertices from a light subpath, joined
 * to t = n - s from an eye subpath. These are the strategies (s, t).
 */
struct Strategies
{
  /// Which (s, t) are used; empty: all. What is left out is missing, unless others find those
  /// paths.
  std::function<bool(int, int)> isUsed;
  /// Those with this many eye vertices use the light subpaths of all bins, see Sensor.
  int sharedEyeVertices = 1;
  double numberOfBins = 1;

  /// How many samples a strategy has for each one that a bin has; 0 if it is not used.
  double samples(int lightVertices, int eyeVertices) const
  {
    if (lightVertices + eyeVertices < 2 || (isUsed && !isUsed(lightVertices, eyeVertices)))
    {
      return 0;
    }
    return eyeVertices == sharedEyeVertices ? numberOfBins : 1;
  }
};

/// The part of a path that one subpath made.
struct PathPart
{
  const PathVertex* vertices; ///< from the end of the path inwards
  int count;
  /// m^-2, with which the other subpath would have chosen the last vertex of this part, and the one
  /// before. Of those farther back the vertices know it themselves.
  double reverseLast = 0, reverseBeforeLast = 0;
};

/**
 * Multiple importance sampling by the balance heuristic (Veach 1997, section 9.2): the weight of a
 * path is the density of its own strategy over the sum of the densities of all. So the weights of
 * all strategies that find the same path sum to 1, and none is drowned in the noise of another.
 */
double balanceWeight(const Strategies& strategies, const PathPart& light, const PathPart& eye);

}
