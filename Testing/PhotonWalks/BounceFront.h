// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BounceBlock.h"

#include <vector>

namespace irradiance::test
{

/// A segment to be stored, and what led to it.
struct BounceSegment
{
  Vector3 origin = Vector3::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();
  double distance = kInfinity;
  std::uint32_t walk = 0;
  std::uint32_t parent = BounceBlock::kNone; ///< slot
  std::uint32_t triangle = BounceBlock::kNone;
  std::array<float, 2> weights{};
  std::uint8_t kind = 0;
  bool isFront = true;
  Power power;
};

/// A front of walks in columns, as shooting would have it.
class BounceFront
{
public:
  std::size_t size() const { return segments_.size(); }
  const BounceSegment& operator[](std::size_t i) const { return segments_[i]; }
  void add(const BounceSegment& segment) { segments_.push_back(segment); }

  /// Stores all of them; returns their slots.
  std::vector<std::uint32_t> appendTo(BounceBlock& block)
  {
    std::vector<std::uint32_t> slots(size());
    block.append(columns(), 0, size(), slots.data());
    return slots;
  }

  /// Valid until something is added.
  BounceColumns columns()
  {
    const std::size_t size = segments_.size() + RayColumns::kPadding;
    for (int axis = 0; axis < 3; ++axis)
    {
      origin_[axis] = column<double>(size, [&](const BounceSegment& s) { return s.origin[axis]; });
      direction_[axis] =
        column<float>(size, [&](const BounceSegment& s) { return s.direction[axis]; });
    }
    distance_ = column<double>(size, [](const BounceSegment& s) { return s.distance; });
    walks_ = column<std::uint32_t>(size, [](const BounceSegment& s) { return s.walk; });
    parents_ = column<std::uint32_t>(size, [](const BounceSegment& s) { return s.parent; });
    triangles_ = column<std::uint32_t>(size, [](const BounceSegment& s) { return s.triangle; });
    second_ = column<float>(size, [](const BounceSegment& s) { return s.weights[0]; });
    third_ = column<float>(size, [](const BounceSegment& s) { return s.weights[1]; });
    kinds_ = column<std::uint8_t>(size, [](const BounceSegment& s) { return s.kind; });
    isFront_ = column<std::uint8_t>(
      size, [](const BounceSegment& s) { return static_cast<std::uint8_t>(s.isFront); });
    for (int band = 0; band < Power::kMaxBands; ++band)
    {
      powers_[band] =
        column<std::int64_t>(size, [&](const BounceSegment& s) { return s.power[band]; });
    }
    return { { { origin_[0].data(), origin_[1].data(), origin_[2].data() },
               { direction_[0].data(), direction_[1].data(), direction_[2].data() },
               distance_.data() },
      walks_.data(), parents_.data(), triangles_.data(), { second_.data(), third_.data() },
      kinds_.data(), isFront_.data(), { powers_[0].data(), powers_[1].data(), powers_[2].data() } };
  }

private:
  template <class Value, class Member>
  std::vector<Value> column(std::size_t size, const Member& member) const
  {
    std::vector<Value> values;
    for (const BounceSegment& segment : segments_)
    {
      values.push_back(member(segment));
    }
    values.resize(size);
    return values;
  }

  std::vector<BounceSegment> segments_;
  std::vector<double> origin_[3], distance_;
  std::vector<float> direction_[3], second_, third_;
  std::vector<std::uint32_t> walks_, parents_, triangles_;
  std::vector<std::uint8_t> kinds_, isFront_;
  std::vector<std::int64_t> powers_[Power::kMaxBands];
};

}
