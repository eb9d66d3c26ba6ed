// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/Frame.h"

#include <vector>

namespace irradiance
{

/// A cell from afar, in world space.
struct CellShape
{
  Vector3 center = Vector3::Zero(); ///< of the area
  double radius = 0;                ///< all corners are within it of the center
  Vector3 normal = Vector3::Zero(); ///< mean over the area: shorter than 1 if the cell is not flat
  double area = 0;                  ///< m2; 0 if the cell is not there
  double mirrored = 0;              ///< what it reflects as mirrors do, of the brightest band
  // Whether no light can come straight from the lights to a side.
  bool isFrontDark = false, isBackDark = false;
};

/// The shapes of cells of a frame, and their triangles. Cells are numbered through all objects.
class CellShapes
{
public:
  /// Of objects [first, end); the cells of others are as if they were not there.
  CellShapes(const Frame& frame, std::uint32_t first, std::uint32_t end,
    const CancelPoint& cancelPoint = {});

  const CellNumbers& numbers() const { return numbers_; }
  std::size_t size() const { return shapes_.size(); }
  std::size_t bytes() const
  {
    return shapes_.capacity() * (sizeof(CellShape) + sizeof(std::size_t)) +
      triangles_.capacity() * sizeof(std::uint32_t);
  }
  const CellShape& operator[](std::size_t cell) const { return shapes_[cell]; }
  void setDark(std::size_t cell, bool isFront, bool isBack)
  {
    shapes_[cell].isFrontDark = isFront;
    shapes_[cell].isBackDark = isBack;
  }
  /// The numbers of the triangles of a cell.
  const std::uint32_t* begin(std::size_t cell) const { return triangles_.data() + firsts_[cell]; }
  const std::uint32_t* end(std::size_t cell) const { return triangles_.data() + firsts_[cell + 1]; }

private:
  void sortTriangles(const SceneObjects& objects, const SceneTriangles& triangles,
    std::uint32_t firstObject, std::uint32_t endObject, ThrottledCancelPoint& pace);
  CellShape shapeOf(std::size_t cell, const SceneTriangles& triangles) const;

  CellNumbers numbers_;
  std::vector<std::size_t> firsts_; ///< in triangles_, by cell
  std::vector<std::uint32_t> triangles_;
  std::vector<CellShape> shapes_;
};

/// A triangle of a frame in world space.
Triangle triangleOf(const SceneTriangles& triangles, std::uint32_t number);

}
