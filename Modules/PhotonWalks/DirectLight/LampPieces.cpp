// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampPieces.h"

#include "Lights/SeenLight.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// How much is uncertain about what a node brings: its flux, its size and the solid angle into
/// which it shines.
double spreadOf(const LampPieces::Node& node)
{
  return node.lamp.flux * node.lamp.radius * node.lamp.radius * node.lamp.cone.solidAngle();
}

}

LampPieces::LampPieces(LightTable lights)
  : lights_(std::move(lights))
{
  Box bounds;
  for (const Light& light : lights_.lights())
  {
    bounds.add(light.stand());
  }
  // What is near the one end of an edge that is shorter is near the other.
  constexpr double kShort = 0.02; // of the diagonal of all lamps
  const double shortest = kShort * bounds.extent().norm();
  for (std::uint32_t i = 0; i < lights_.lights().size(); ++i)
  {
    addPieces(lights_[i], i, shortest, pieces_);
    if (lights_[i].surface())
    {
      areas_.push_back(i);
    }
  }
  for (const LampPiece& piece : pieces_)
  {
    centers_.add(piece.center);
    arePlain_ = arePlain_ && !piece.distribution && !piece.part;
  }
  order_.resize(pieces_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (!pieces_.empty())
  {
    nodes_.push_back(nodeOf(0, static_cast<std::uint32_t>(pieces_.size())));
  }
  for (std::uint32_t number = 0; number < nodes_.size(); ++number)
  {
    split(number);
  }
  places_.resize(pieces_.size());
  for (std::uint32_t place = 0; place < order_.size(); ++place)
  {
    places_[order_[place]] = place;
  }
}

LampPieces::Node LampPieces::nodeOf(std::uint32_t first, std::uint32_t end) const
{
  Node node;
  node.first = first;
  node.end = end;
  if (end - first == 1)
  {
    node.lamp = pieces_[order_[first]];
    return node;
  }
  Box bounds;
  Vector3 normals = Vector3::Zero();
  bool areFlat = true, areOfOne = true;
  double perArea = 0; // W/m2 of what is distant, across
  node.lamp.share = 0;
  node.lamp.flux = 0;
  for (std::uint32_t place = first; place < end; ++place)
  {
    const LampPiece& piece = pieces_[order_[place]];
    bounds.add(piece.bounds());
    node.lamp.flux += piece.flux;
    normals += piece.flux * piece.normal;
    perArea += piece.crossSection > 0 ? piece.flux / piece.crossSection : -kInfinity;
    areFlat = areFlat && piece.cone.isFlat();
    areOfOne = areOfOne && piece.distribution == pieces_[order_[first]].distribution;
  }
  // Faces of one luminaire, those that look away from a cell apart from the others.
  node.lamp.distribution = areOfOne ? pieces_[order_[first]].distribution : nullptr;
  node.lamp.crossSection = perArea > 0 ? node.lamp.flux / perArea : 0;
  node.lamp.center = bounds.center();
  node.lamp.radius = bounds.extent().norm() / 2;
  if (areFlat && areOfOne && !normals.isZero(1e-9 * node.lamp.flux))
  {
    node.lamp.normal = normals.normalized();
    double cosine = 1;
    for (std::uint32_t place = first; place < end; ++place)
    {
      const LampPiece& piece = pieces_[order_[place]];
      cosine = std::min(cosine, node.lamp.normal.dot(piece.normal));
      node.depth = std::max(node.depth, node.lamp.normal.dot(node.lamp.center - piece.center));
    }
    constexpr double kFlat = 1 - 1e-12;
    cosine = cosine >= kFlat ? 1 : std::max(cosine, -1.0);
    node.lamp.face = cosine == 1 ? pieces_[order_[first]].face : IntensityDistribution::Face{};
    node.lamp.cone = { cosine, std::sqrt(1 - cosine * cosine) };
  }
  return node;
}

/// At the median along the longest edge of the bounds, or where normals differ most: as leaves less
/// spread.
void LampPieces::split(std::uint32_t number)
{
  const std::uint32_t first = nodes_[number].first, end = nodes_[number].end;
  if (end - first == 1)
  {
    return;
  }
  Box centers, normals;
  for (std::uint32_t place = first; place < end; ++place)
  {
    centers.add(pieces_[order_[place]].center);
    normals.add(pieces_[order_[place]].normal);
  }
  const std::uint32_t middle = first + (end - first) / 2;
  const auto at = [&](std::uint32_t place) { return order_.begin() + place; };
  const auto halve = [&](const Vector3 LampPiece::*value, const Box& box) {
    Eigen::Index axis = 0;
    box.extent().maxCoeff(&axis);
    std::nth_element(at(first), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      const double left = (pieces_[a].*value)[axis], right = (pieces_[b].*value)[axis];
      return left < right || (left == right && a < b);
    });
    return std::pair(nodeOf(first, middle), nodeOf(middle, end));
  };
  const auto spreadOfBoth = [](const std::pair<Node, Node>& halves) {
    return spreadOf(halves.first) + spreadOf(halves.second);
  };
  std::pair<Node, Node> halves = halve(&LampPiece::center, centers);
  if (normals.extent().maxCoeff() > 0)
  {
    const std::vector<std::uint32_t> byPlace(at(first), at(end));
    std::pair<Node, Node> byNormal = halve(&LampPiece::normal, normals);
    if (spreadOfBoth(byNormal) < spreadOfBoth(halves))
    {
      halves = std::move(byNormal);
    }
    else
    {
      std::copy(byPlace.begin(), byPlace.end(), at(first));
    }
  }
  nodes_[number].children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(std::move(halves.first));
  nodes_.push_back(std::move(halves.second));
}

WeightChoice LampPieces::choose(const Node& node, double part) const
{
  const Node* below = &node;
  while (!below->isLeaf())
  {
    const Node* halves = &nodes_[below->children];
    const double first = halves->lamp.flux / below->lamp.flux;
    below = choosesFirst(first, part) ? halves : halves + 1;
  }
  return { order_[below->first], below->lamp.flux / node.lamp.flux, part };
}

std::optional<std::uint32_t> LampPieces::lightOn(const TriangleId& triangle) const
{
  const auto key = [](const TriangleId& id) { return std::pair(id.object, id.triangle); };
  const auto found = std::lower_bound(
    areas_.begin(), areas_.end(), triangle, [&](std::uint32_t light, const TriangleId& id) {
      return key(lights_[light].triangle()) < key(id);
    });
  return found != areas_.end() && lights_[*found].triangle() == triangle
    ? std::optional<std::uint32_t>(*found)
    : std::nullopt;
}

std::vector<std::uint32_t> LampPieces::lightsAt(
  const Contacts& contacts, const TriangleId& triangle) const
{
  std::vector<std::uint32_t> lights;
  contacts.forEachLampAt(triangle, [&](const TriangleId& id) {
    if (const std::optional<std::uint32_t> light = lightOn(id))
    {
      lights.push_back(*light);
    }
  });
  return lights;
}

/// Rounding may leave the place beside all of them: then the nearest, roughly.
std::uint32_t LampPieces::pieceAt(std::uint32_t light, const Vector3& place) const
{
  const auto first = std::lower_bound(pieces_.begin(), pieces_.end(), light,
    [](const LampPiece& piece, std::uint32_t value) { return piece.light < value; });
  const auto end = std::upper_bound(first, pieces_.end(), light,
    [](std::uint32_t value, const LampPiece& piece) { return value < piece.light; });
  const auto inside = [&](const LampPiece& piece) {
    return weightsInPlane(piece.triangle, place).minCoeff();
  };
  const auto found = std::max_element(
    first, end, [&](const LampPiece& a, const LampPiece& b) { return inside(a) < inside(b); });
  return static_cast<std::uint32_t>(found - pieces_.begin());
}

}
