#include "UnitCast.h"

#include "SimdLevel.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

bool UnitCast::prepare(const TriangleTree& searched, const Vector3& worldOrigin,
  const Vector3& worldDirection, double worldFrom, double bound)
{
  if (searched.isEmpty())
  {
    return false;
  }
  tree = &searched;
  const double largest = worldDirection.cwiseAbs().maxCoeff();
  exactOrigin = searched.frame()(worldOrigin);
  exactDirection = worldDirection / largest;
  rate_ = largest * searched.frame().scale;
  const double distant = exactOrigin.cwiseAbs().maxCoeff();
  const double steepest = exactDirection.cwiseAbs().minCoeff();
  // With a NaN or an infinite number the plain search ends by itself.
  isForFloats = steepest >= kSmallestComponent && distant <= kLargestOrigin;
  from = std::max(0.0, worldFrom * rate_ - tree->slack());
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
    inverse[3] = 1;
    originInverse[3] = 0;
    pad = static_cast<float>(2 * padding);
    slack = static_cast<float>(tree->slack() + kBlur);
    edgeBlur = static_cast<float>(kEdgeBlur + 4 * tree->blur());
    leastBlur = static_cast<float>(kLeastBlur + 32 * tree->blur());
  }
  setBound(bound);
  return !isForFloats || limit >= 0;
}

void UnitCast::setBound(double bound)
{
  const double end = bound * rate_ + tree->slack();
  exactLimit = end;
  // What lies within the pad is looked at; rounding is far less.
  limit = static_cast<float>(std::min((end - entry) + pad, kFarthest));
}

void runCasts(CastSource& source)
{
#ifdef __x86_64__
  switch (simdLevel())
  {
    case SimdLevel::Avx512:
      return runCastsAvx512(source);
    case SimdLevel::Avx2:
      return runCastsAvx2(source);
    case SimdLevel::Plain:
      break;
  }
#endif
  runCastsPlain(source);
}

}
