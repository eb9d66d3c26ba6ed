// SPDX-License-Identifier: BSD-3-Clause
// No include guard: a part of WideQuery.inl.

namespace irradiance
{
namespace
{

/// Prepares a search in floats; clears isForFloats where they cannot follow. False if the ray misses
/// the tree's box or enters it too late.
template <class Lanes>
inline bool prepare(const QueryRequest& request, TreeQuery& query)
{
  using Triple = typename Lanes::Triple;
  const TriangleTree& tree = *request.tree;
  const Triple worldDirection = Lanes::load(request.direction);
  const double largest = Lanes::mostOf(Lanes::absolute(worldDirection));
  query.set(request, largest);
  const Triple direction = worldDirection / Lanes::triple(largest);
  const Triple inverse = Lanes::triple(largest) / worldDirection;
  const Triple origin = (Lanes::load(request.origin) - Lanes::load(tree.frame().center)) *
    Lanes::triple(tree.frame().scale);
  const double flattest = Lanes::mostOf(Lanes::absolute(inverse));
  // With an infinite number this is false; the search in double can handle it.
  query.isForFloats = flattest <= 1 / TreeQuery::kSmallestComponent &&
    Lanes::mostOf(Lanes::absolute(origin)) <= TreeQuery::kLargestOrigin;
  if (!query.isForFloats)
  {
    return true;
  }
  const Triple lower = (Lanes::load(tree.bounds().lower) - origin) * inverse;
  const Triple upper = (Lanes::load(tree.bounds().upper) - origin) * inverse;
  query.entry = std::max(query.from(request), Lanes::mostOf(Lanes::least(lower, upper)));
  const double exit = Lanes::leastOf(Lanes::most(lower, upper));
  const double padding = TreeQuery::kBlur * flattest;
  if (query.entry > exit + padding)
  {
    return false;
  }
  Lanes::storeFloats(query.origin, origin + direction * Lanes::triple(query.entry));
  Lanes::storeFloats(query.direction, direction);
  Lanes::storeFloats(query.inverse, inverse);
  for (int i = 0; i < 4; ++i)
  {
    query.originInverse[i] = query.origin[i] * query.inverse[i];
  }
  query.octant = Lanes::octantOf(worldDirection);
  query.setMargins(padding);
  query.setBehind(request);
  query.setBound(request.bound);
  return query.limit >= 0;
}

}
}
