// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/NearestPhotons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace irradiance
{

namespace
{

constexpr float kInfinite = std::numeric_limits<float>::infinity();
/// Pays for the rounding of squares and roots of floats.
constexpr float kWider = 1 + 0x1p-18F;
/// Searches for more photons than this take memory as they go.
constexpr std::size_t kUsualCount = 1024;

}

/// One search. Distances are in search units (see PlacedTree) unless they say otherwise.
class NearestPhotons::Search
{
public:
  Search(const NearestPhotons& owner, const Foot& foot, std::size_t count, double maximumRadius)
    : owner_(owner)
    , foot_(foot)
    , sensor_(foot.sensor)
    , count_(count)
    , maximumRadius_(maximumRadius)
    , limit_(static_cast<float>(maximumRadius * owner.searchUnitsPerWorldUnit_) * kWider)
    , enough_(count)
  {
    // Of usual searches.
    nodes_.reserve(owner.lit_.size() + std::size_t{ 8 } * Treelet::kSize);
    candidates_.reserve(3 * std::min(count, kUsualCount));
    for (const std::uint32_t object : owner.lit_)
    {
      const double distance = owner.trees_[object].distanceAtLeast(foot.sensor.position);
      const auto atLeast = static_cast<float>(distance * owner.searchUnitsPerWorldUnit_) / kWider;
      if (atLeast <= limit_)
      {
        push({ atLeast, object, kObject });
      }
    }
  }

  NearPhotons run()
  {
    while (!nodes_.empty() && nodes_.front().distance <= limit_)
    {
      const Node node = nodes_.front();
      std::pop_heap(nodes_.begin(), nodes_.end());
      nodes_.pop_back();
      if (node.link == kObject)
      {
        const std::uint32_t object = node.view, view = static_cast<std::uint32_t>(views_.size());
        views_.push_back(
          { object, owner_.trees_[object].see(sensor_), owner_.seen(object, foot_) });
        push({ node.distance, view, owner_.leaves_.tree(object).root() });
      }
      else
      {
        (node.link & Treelet::kLeaf) != 0 ? searchLeaf(node) : open(node);
      }
    }
    return nearest();
  }

private:
  struct View
  {
    std::uint32_t object;
    LocalSensor sensor;
    SeenSurface surface;

    /// Of what lies this far away in the unit frame; less by the blur.
    float lowerBound(float squaredUnitDistance) const
    {
      return sensor.least * std::sqrt(squaredUnitDistance) - sensor.blur;
    }
    float squaredUnitLimit(float limit) const
    {
      const float unit = (limit + sensor.blur) / sensor.least;
      return unit * unit * kWider;
    }
  };

  static constexpr std::uint32_t kObject = Treelet::kEmpty;

  struct Node
  {
    float distance;     ///< a lower bound
    std::uint32_t view; ///< or the object itself, as long as it has not been looked at
    std::uint32_t link; ///< a treelet, a leaf, or kObject

    /// The nearest comes first in a queue; what is equally near in a fixed order.
    friend bool operator<(const Node& a, const Node& b)
    {
      return std::tie(a.distance, a.view, a.link) > std::tie(b.distance, b.view, b.link);
    }
  };

  /// A photon whose distance is between two bounds.
  struct Candidate
  {
    float lower, upper;
    SegmentRef photon;
  };

  void push(const Node& node)
  {
    nodes_.push_back(node);
    std::push_heap(nodes_.begin(), nodes_.end());
  }

  void open(const Node& node)
  {
    const View& view = views_[node.view];
    const Treelet& treelet = owner_.leaves_.tree(view.object).treelets()[node.link];
    const auto squared = irradiance::squaredDistances(treelet, view.sensor.position);
    const float squaredLimit = view.squaredUnitLimit(limit_);
    for (unsigned child = 0; child < Treelet::kSize; ++child)
    {
      if (squared[child] <= squaredLimit && treelet.children[child] != Treelet::kEmpty)
      {
        push({ view.lowerBound(squared[child]), node.view, treelet.children[child] });
      }
    }
  }

  void searchLeaf(const Node& node)
  {
    const View& view = views_[node.view];
    float limit = limit_, squaredUnitLimit = view.squaredUnitLimit(limit);
    owner_.leaves_.leaf(view.object, node.link & ~Treelet::kLeaf)
      .visitNear(
        view.sensor.position,
        [&] {
          if (limit_ < limit)
          {
            limit = limit_;
            squaredUnitLimit = view.squaredUnitLimit(limit);
          }
          return squaredUnitLimit;
        },
        [&](const PhotonPack& pack) { test(view, pack); });
  }

  void test(const View& view, const PhotonPack& pack)
  {
    const std::array<float, PhotonPack::kSize> distances = distancesTo(view, pack);
    // Which lanes are near is unpredictable, so there are no branches here.
    std::array<unsigned, PhotonPack::kSize> near;
    unsigned count = 0;
    for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
    {
      near[count] = lane;
      count += distances[lane] <= limit_ + view.sensor.blur ? 1 : 0;
    }
    for (unsigned i = 0; i < count; ++i)
    {
      const unsigned lane = near[i];
      if (counts(view, pack.triangle(lane), pack.isFront(lane)))
      {
        candidates_.push_back({ distances[lane] - view.sensor.blur,
          distances[lane] + view.sensor.blur, pack.reference(lane) });
      }
    }
    if (candidates_.size() >= enough_)
    {
      tighten();
      enough_ = candidates_.size() + std::max<std::size_t>(count_, PhotonPack::kSize);
    }
  }

  std::array<float, PhotonPack::kSize> distancesTo(const View& view, const PhotonPack& pack) const
  {
    const Eigen::Matrix3f& stretch = view.sensor.stretch;
    const UnitPoint& at = view.sensor.position;
    std::array<float, PhotonPack::kSize> distances;
    for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
    {
      const float x = pack.coordinates(0)[lane] - at[0], y = pack.coordinates(1)[lane] - at[1],
                  z = pack.coordinates(2)[lane] - at[2];
      const float u = stretch(0, 0) * x + stretch(0, 1) * y + stretch(0, 2) * z,
                  v = stretch(1, 0) * x + stretch(1, 1) * y + stretch(1, 2) * z,
                  w = stretch(2, 0) * x + stretch(2, 1) * y + stretch(2, 2) * z;
      distances[lane] = std::sqrt(u * u + v * v + w * w);
    }
    return distances;
  }

  bool counts(const View& view, std::uint32_t triangle, bool isFront)
  {
    // Photons of few triangles are near.
    auto& [known, side] = sides_[triangle % sides_.size()];
    const TriangleId id{ view.object, triangle };
    if (known != id)
    {
      known = id;
      side = view.surface.side(triangle);
    }
    return side == (isFront ? 1 : -1);
  }

  /// Drops candidates that are certainly not among the nearest.
  void tighten()
  {
    limit_ = std::min(limit_, lastOf<&Candidate::upper>());
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                        [this](const Candidate& c) { return c.lower > limit_; }),
      candidates_.end());
  }

  NearPhotons nearest()
  {
    tighten();
    NearPhotons found{ {}, maximumRadius_, true };
    found.photons.reserve(candidates_.size());
    // As many true distances as lower bounds are below this: what is below for certain is found.
    const auto certain = std::partition(candidates_.begin(), candidates_.end(),
      [limit = certainLimit()](const Candidate& c) { return c.upper < limit; });
    for (auto c = candidates_.begin(); c != certain; ++c)
    {
      found.photons.push_back(c->photon);
    }
    std::vector<std::pair<double, SegmentRef>> exact; // distances squared
    for (auto c = certain; c != candidates_.end(); ++c)
    {
      const double squared = owner_.squaredDistance(sensor_, c->photon);
      if (squared <= maximumRadius_ * maximumRadius_)
      {
        exact.emplace_back(squared, c->photon);
      }
    }
    std::sort(exact.begin(), exact.end());
    for (std::size_t i = 0; i < exact.size() && found.photons.size() < count_; ++i)
    {
      found.photons.push_back(exact[i].second);
      if (found.photons.size() == count_)
      {
        found.radius = std::sqrt(exact[i].first);
        found.areAll = false;
      }
    }
    return found;
  }

  float certainLimit()
  {
    const float within =
      static_cast<float>(maximumRadius_ * owner_.searchUnitsPerWorldUnit_) / kWider;
    return std::min(within, lastOf<&Candidate::lower>());
  }

  /// The bound that as many candidates do not exceed as are asked for; infinite if there are fewer.
  template <float Candidate::*kBound>
  float lastOf()
  {
    if (candidates_.size() < count_)
    {
      return kInfinite;
    }
    const auto last = candidates_.begin() + static_cast<std::ptrdiff_t>(count_ - 1);
    std::nth_element(candidates_.begin(), last, candidates_.end(),
      [](const Candidate& a, const Candidate& b) { return a.*kBound < b.*kBound; });
    return (*last).*kBound;
  }

  const NearestPhotons& owner_;
  const Foot& foot_;
  const Sensor& sensor_;
  std::size_t count_;
  double maximumRadius_; ///< world
  float limit_;          ///< the nearest are no farther
  std::size_t enough_;   ///< candidates, to look which can be dropped
  std::vector<View> views_;
  std::vector<Node> nodes_; ///< a heap
  std::vector<Candidate> candidates_;
  std::array<std::pair<TriangleId, int>, 64> sides_; ///< which count, of triangles asked for last
};

NearestPhotons::NearestPhotons(const LeafPhotons& leaves, const Surfaces& surfaces,
  const SceneObjects& objects, const WalkHistories& histories)
  : leaves_(leaves)
  , surfaces_(surfaces)
  , objects_(objects)
  , histories_(histories)
  , bounds_(objects.worldBounds())
  , searchUnitsPerWorldUnit_(UnitFrame(bounds_).scale)
{
  trees_.reserve(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    trees_.emplace_back(objects[i], searchUnitsPerWorldUnit_);
    if (!objects[i].isEmpty() && !leaves.isEmpty(i))
    {
      lit_.push_back(i);
    }
  }
}

std::optional<Foot> NearestPhotons::footOf(const Sensor& sensor, double maximumDistance) const
{
  // In sizes of the scene. From there a disc of a fiftieth of the scene is as far as its middle.
  constexpr double kFarthest = 0x1p20;
  const Vector3 away = (bounds_.lower - sensor.position).cwiseMax(sensor.position - bounds_.upper);
  return away.maxCoeff() * searchUnitsPerWorldUnit_ > kFarthest
    ? std::nullopt
    : findFoot(objects_, surfaces_, trees_, sensor, maximumDistance);
}

NearPhotons NearestPhotons::find(const Foot& foot, std::size_t count, double maximumRadius) const
{
  return Search(*this, foot, count, maximumRadius).run();
}

double NearestPhotons::areaWithin(const Foot& foot, double radius) const
{
  double area = 0;
  for (std::uint32_t i = 0; i < objects_.size(); ++i)
  {
    const bool isNear = trees_[i].distanceAtLeast(foot.sensor.position) <= radius;
    area += isNear ? seen(i, foot).areaWithin(radius) : 0.0;
  }
  return area;
}

NearestEstimate nearestEstimate(
  const NearestPhotons& photons, const Foot& foot, std::uint32_t count, double maximumRadius)
{
  const NearPhotons near = photons.find(foot, count, maximumRadius);
  const std::size_t counted = near.photons.size() - (near.areAll ? 0 : 1);
  NearestEstimate estimate{ {}, kInfinity, near.radius,
    static_cast<std::uint32_t>(near.photons.size()) };
  for (std::size_t i = 0; i < counted; ++i)
  {
    estimate.power += photons.power(near.photons[i]);
  }
  if (!estimate.power.isZero())
  {
    estimate.area = photons.areaWithin(foot, near.radius);
  }
  return estimate;
}

double usualRadius(const NearestPhotons& photons, std::uint32_t count)
{
  double area = 0;
  for (std::uint32_t i = 0; i < photons.objects().size(); ++i)
  {
    const std::vector<double> areas = cellAreas(photons.objects()[i]);
    area = std::accumulate(areas.begin(), areas.end(), area);
  }
  const auto all = static_cast<double>(photons.numberOfPhotons());
  return std::min(4 * std::sqrt(count * area / all / kPi), 0.25 * photons.bounds().size());
}

/// Points of a ball stray from its triangles by a hundredth of its size if its circles have 16
/// sides, and it is smaller than the scene. A working plane in a hall of 100 m is farther away.
double usualDistance(const NearestPhotons& photons)
{
  return photons.bounds().size() / 128;
}

}
