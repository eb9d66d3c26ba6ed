// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/TreeQuery.h"

#include "Simd/SimdLevel.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

bool TreeQuery::prepare(const QueryRequest& request)
{
  if (request.tree->isEmpty())
  {
    return false;
  }
  tree = request.tree;
  skipped = request.skipped;
  job = request.job;
  isShared = request.isShared;
  const double largest = request.direction.cwiseAbs().maxCoeff();
  exactOrigin = tree->frame()(request.origin);
  exactDirection = request.direction / largest;
  rate = largest * tree->frame().scale;
  const double distant = exactOrigin.cwiseAbs().maxCoeff();
  const double steepest = exactDirection.cwiseAbs().minCoeff();
  // With a NaN or an infinite number this is false, and the plain search ends by itself.
  isForFloats = steepest >= kSmallestComponent && distant <= kLargestOrigin;
  from = std::max(0.0, request.from * rate - tree->slack());
  entry = from;
  double exit = kInfinity;
  const Box& box = tree->bounds();
  if (isForFloats)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double reciprocal = 1 / exactDirection[i];
      const double lower = (box.lower[i] - exactOrigin[i]) * reciprocal;
      const double upper = (box.upper[i] - exactOrigin[i]) * reciprocal;
      entry = std::max(entry, std::min(lower, upper));
      exit = std::min(exit, std::max(lower, upper));
      inverse[i] = static_cast<float>(reciprocal);
    }
    const double padding = kBlur / steepest;
    if (entry > exit + padding)
    {
      return false;
    }
    const Vector3 begin = exactOrigin + entry * exactDirection;
    octant = 0;
    for (int i = 0; i < 3; ++i)
    {
      origin[i] = static_cast<float>(begin[i]);
      direction[i] = static_cast<float>(exactDirection[i]);
      originInverse[i] = origin[i] * inverse[i];
      octant |= (exactDirection[i] < 0 ? 1u : 0u) << i;
    }
    setMargins(padding);
  }
  setBound(request.bound);
  return !isForFloats || limit >= 0;
}

void runQueries(QuerySource& source)
{
  IRRADIANCE_CALL_BEST(runQueries, source);
}

}
