// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DirectPlan.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolNet.h"

#include <array>
#include <utility>
#include <vector>

namespace irradiance
{

/// A point of a cell, and a point of a light from which light may come to it.
struct DirectSample
{
  std::uint32_t triangle; ///< the number of the cell's triangle
  float weightB, weightC; ///< of its second and third corner
  bool isFront;           ///< light comes to the front
  std::uint32_t light;
  Vector3 from; ///< the point of the light, clear of its surface
  Vector3 to;   ///< the point of the cell, clear of its surface
  /// The part of the light's flux that the sample brings to its cell if nothing stands between; 0
  /// if none can come. The mean over all samples of the sum over a cell's samples is what arrives.
  double part;
};

/**
 * Samples with which cells gather the light that comes straight from the lights of a table: points
 * of the cell from a low-discrepancy net, each with a light that LampChoice chooses and a point of
 * it.
 *
 * Where both are far from each other, both points are chosen evenly over the area. Where one is
 * large as seen from the other, its point is chosen by solid angle, so that no sample brings much
 * more than others. Where a cell and a light coincide, what the light emits arrives in the cell,
 * see Contacts. All is a pure function of the scene, the seed, the cell and the number of the
 * sample.
 */
class CellSampler
{
public:
  /// The arguments must outlive it.
  CellSampler(const CellShapes& cells, const Frame& frame, const LampPieces& lamps,
    const DirectPlan& plan, std::uint64_t seed);

  /// For the samples that are made next.
  void setCell(std::size_t cell);
  /// `number`: among the samples of the cell.
  DirectSample sample(std::uint32_t number) const;

private:
  using Square = std::array<double, 2>;
  /// A triangle of the cell.
  struct Part
  {
    std::uint32_t number;
    Triangle triangle;
    double area;
    std::vector<std::uint32_t> touching; ///< lights that coincide with it
  };

  /// Samples of a cell from which on one net is better than two.
  static constexpr std::uint32_t kOneNet = 64;

  /// The coordinates of a sample, on the cell and on the light.
  std::pair<Square, Square> squares(std::uint32_t number) const;
  /// The triangle that a coordinate chooses by area. The coordinate becomes what the choice left of
  /// it.
  const Part& choosePart(double& u) const;
  static SurfacePoint cellPoint(const Part& part, const Vector3& weights, DirectSample& sample);
  // Each sets all of the sample but the triangle; `part` as if it were the only sample.
  void gather(const Part& part, Square onCell, Square onLight, DirectSample& sample) const;
  void gatherFrom(const LampPiece& lamp, const Part& part, Square onCell, Square onLight,
    DirectSample& sample) const;
  /// From a light that coincides with the triangle at a point. `uLight`: chooses the light.
  void gatherFromAfar(const LampPiece& lamp, const Part& part, const Square& onCell,
    const Square& onLight, DirectSample& sample) const;
  void gatherTouching(const Part& part, const Square& u, double uLight, DirectSample& sample) const;
  const Triangle& touchingTriangle(std::uint32_t light) const
  {
    return *lamps_.lights()[light].surface();
  }
  /// Sets the ray from the point of a light that coincides with the cell there.
  void cross(std::uint32_t light, const Vector3& weights, const SurfacePoint& onCell,
    DirectSample& sample) const;

  const CellShapes& cells_;
  const Frame& frame_;
  const LampPieces& lamps_;
  const DirectPlan& plan_;
  std::uint64_t seed_;
  LampChoice choice_;
  std::size_t cell_ = 0;
  std::vector<Part> parts_;   ///< of the cell
  std::vector<double> areas_; ///< of its triangles up to and including each, m2
  // Of the cell: one net where it has many samples, else two that are shuffled against each other.
  SobolNet net_;
  SampleKeys cellKeys_{}, lightKeys_{};
};

}
