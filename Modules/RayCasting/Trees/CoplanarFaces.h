// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CoplanarFaces_h
#define irradiance_CoplanarFaces_h

#include "Progress/CancelPoint.h"
#include "Trees/KdCost.h"
#include "Trees/KdItem.h"

#include <array>
#include <cstdint>

namespace irradiance
{

/// The items that lie flat in the faces of the hull of all items: the walls of a room, the sides of
/// a box. Face 2 i is the lower one on axis i, face 2 i + 1 the upper one.
class CoplanarFaces
{
public:
  static constexpr int kFaces = 6;

  CoplanarFaces(const KdItems& items, ThrottledCancelPoint& pace);

  /// False if there are none, or if one of them is all.
  bool areAny() const;
  /// The number of items in a face, 0 if each of them is in a face before this one. An item in an
  /// edge of the hull is in two faces.
  std::uint32_t count(int face) const
  {
    const auto i = static_cast<std::size_t>(face);
    return parts_[i].count > 0 ? counts_[i] : 0;
  }
  /// Of the face on its axis.
  float place(int face) const
  {
    return face % 2 == 0 ? hull_.lower[face / 2] : hull_.upper[face / 2];
  }
  /// The expected cost of a ray that enters the cell if a plane cuts off each sheet.
  double costOfCuttingAll(const KdCost& cost, const Box& cell) const;

private:
  struct Part
  {
    KdBounds bounds;
    std::uint32_t count = 0;

    void add(const KdItem& item)
    {
      bounds.add(item);
      ++count;
    }
    /// For a ray that enters a cell of this half area.
    double cost(const KdCost& cost, double cellArea) const
    {
      return count == 0 ? 0 : bounds.halfArea() / cellArea * cost.leaf(count);
    }
  };

  bool isIn(std::size_t face, const KdItem& item) const;

  KdBounds hull_;
  std::array<std::uint32_t, kFaces> counts_ = {};
  /// The sheets, each item in its first one, and last what is in none.
  std::array<Part, kFaces + 1> parts_;
};

}

#endif
