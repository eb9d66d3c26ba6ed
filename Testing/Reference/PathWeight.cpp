// SPDX-License-Identifier: BSD-3-Clause
#include "PathWeight.h"

namespace pathtracedroom
{

namespace
{

/**
 * The densities of the strategies in which `part` is shorter, relative to the path's own density.
 * Each vertex that goes over to the other subpath changes one factor: the density with which the
 * one chooses it becomes the density with which the other does. `samples(i)` is for a part of i
 * vertices. Beside a mirror nothing can be joined.
 */
template <class Samples>
double sumOfShorter(const PathPart& part, const Samples& samples)
{
  double ratio = 1, sum = 0;
  for (int i = part.count - 1; i >= 0; --i)
  {
    const PathVertex& vertex = part.vertices[i];
    const double reverse = i == part.count - 1 ? part.reverseLast
      : i == part.count - 2                    ? part.reverseBeforeLast
                                               : vertex.reverseDensity;
    ratio *= reverse / vertex.density;
    const bool isAtMirror =
      (i > 0 && part.vertices[i - 1].isMirrored) || (i < part.count - 1 && vertex.isMirrored);
    sum += isAtMirror ? 0 : ratio * samples(i);
  }
  return sum;
}

}

double balanceWeight(const Strategies& strategies, const PathPart& light, const PathPart& eye)
{
  const double own = strategies.samples(light.count, eye.count);
  const int all = light.count + eye.count;
  const double others =
    sumOfShorter(light, [&](int count) { return strategies.samples(count, all - count); }) +
    sumOfShorter(eye, [&](int count) { return strategies.samples(all - count, count); });
  return own / (own + others);
}

}
