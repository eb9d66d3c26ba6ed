// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/DetailTrees.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace irradiance
{

namespace
{

/// Of the mesh's extent: smaller triangles span less than 64 floats of its tree.
constexpr double kTiny = 0x1p-19;
/// A detail spans at most so many times its median triangle.
constexpr double kFinest = 0x1p12;
/// A search in a tree of its own does not pay for fewer triangles, nor in more trees.
constexpr std::size_t kFewestTriangles = 64, kMostDetails = 16;

struct TinyTriangle
{
  std::uint32_t number;
  Vector3 center;
  double size;
};

using Tiny = std::vector<TinyTriangle>;

Tiny tinyOf(const TriangleMesh& mesh, const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  const double limit = kTiny * mesh.bounds().size();
  Tiny tiny;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    const Box box = mesh[i].bounds();
    const double size = box.extent().maxCoeff();
    if (size < limit)
    {
      tiny.push_back({ i, box.center(), size });
    }
    pace.step();
  }
  return tiny;
}

double medianSize(Tiny::iterator begin, Tiny::iterator end)
{
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end,
    [](const TinyTriangle& a, const TinyTriangle& b) { return a.size < b.size; });
  return middle->size;
}

/// Where to halve centers on an axis along which they extend: in the gap nearest to the middle, if
/// one is wide, as what is cut may be left with too few triangles.
double cutOf(Tiny::const_iterator begin, Tiny::const_iterator end, const Box& box, int axis)
{
  constexpr int kBins = 64;
  const double lower = box.lower[axis], bin = box.extent()[axis] / kBins;
  std::array<bool, kBins> isFull{};
  std::for_each(begin, end, [&](const TinyTriangle& triangle) {
    const double place = (triangle.center[axis] - lower) / bin;
    isFull[static_cast<std::size_t>(std::min(place, kBins - 1.0))] = true;
  });
  for (int i = 0; i < kBins; ++i)
  {
    const int nearest = kBins / 2 + (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
    if (!isFull[static_cast<std::size_t>(nearest)])
    {
      return lower + (nearest + 0.5) * bin;
    }
  }
  return box.center()[axis];
}

/// Halves what is too wide for one detail.
void divide(Tiny::iterator begin, Tiny::iterator end,
  std::vector<std::vector<std::uint32_t>>& details, const CancelPoint& cancelPoint)
{
  if (end - begin < static_cast<std::ptrdiff_t>(kFewestTriangles))
  {
    return;
  }
  ThrottledCancelPoint pace(cancelPoint);
  Box box;
  std::for_each(begin, end, [&](const TinyTriangle& triangle) {
    box.add(triangle.center);
    pace.step();
  });
  int axis;
  const double extent = box.extent().maxCoeff(&axis);
  const bool isOne = extent <= kFinest * medianSize(begin, end);
  const double cut = isOne ? HUGE_VAL : cutOf(begin, end, box, axis);
  const auto half = std::partition(
    begin, end, [&](const TinyTriangle& triangle) { return triangle.center[axis] < cut; });
  if (half == begin || half == end) // one detail, or rounding leaves nothing to halve
  {
    details.emplace_back();
    std::transform(begin, end, std::back_inserter(details.back()),
      [](const TinyTriangle& triangle) { return triangle.number; });
    std::sort(details.back().begin(), details.back().end());
    return;
  }
  divide(begin, half, details, cancelPoint);
  divide(half, end, details, cancelPoint);
}

TriangleTree treeOfSome(const TriangleMesh& mesh, const std::vector<std::uint32_t>& numbers,
  const CancelPoint& cancelPoint)
{
  std::vector<Triangle> some;
  some.reserve(numbers.size());
  std::transform(numbers.begin(), numbers.end(), std::back_inserter(some),
    [&](std::uint32_t number) { return mesh[number]; });
  TriangleTree tree = treeOf(some, cancelPoint);
  tree.renumber(numbers);
  return tree;
}

}

std::vector<std::vector<std::uint32_t>> detailsOf(
  const TriangleMesh& mesh, const CancelPoint& cancelPoint)
{
  Tiny tiny = tinyOf(mesh, cancelPoint);
  std::vector<std::vector<std::uint32_t>> details;
  divide(tiny.begin(), tiny.end(), details, cancelPoint);
  if (details.size() > kMostDetails)
  {
    std::stable_sort(details.begin(), details.end(),
      [](const auto& a, const auto& b) { return a.size() > b.size(); });
    details.resize(kMostDetails);
  }
  return details;
}

std::vector<TriangleTree> detailTreesOf(const TriangleMesh& mesh, const CancelPoint& cancelPoint)
{
  const std::vector<std::vector<std::uint32_t>> details = detailsOf(mesh, cancelPoint);
  if (details.empty())
  {
    return {};
  }
  std::vector<bool> isDetail(mesh.size(), false);
  for (const std::vector<std::uint32_t>& detail : details)
  {
    for (const std::uint32_t number : detail)
    {
      isDetail[number] = true;
    }
  }
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    if (!isDetail[i])
    {
      others.push_back(i);
    }
  }
  std::vector<TriangleTree> trees;
  trees.push_back(treeOfSome(mesh, others, cancelPoint));
  for (const std::vector<std::uint32_t>& detail : details)
  {
    trees.push_back(treeOfSome(mesh, detail, cancelPoint));
  }
  return trees;
}

}
