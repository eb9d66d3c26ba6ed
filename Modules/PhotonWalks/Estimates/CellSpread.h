// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/ErrorEstimate.h"
#include "Estimates/SurfaceDiffusion.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace irradiance
{

/**
 * Distributes the power that small cells received over neighbouring ones (sections 4.1 and 6 of the
 * paper). What a photon gives to which cell depends on the cells alone, so it is done to the sums,
 * and nothing is stored for a photon. Power is conserved to the quantum.
 *
 * Light does not flow across creases, to other objects, or from one side of a cell to the other if
 * sides are told apart. See CellNeighbours, CellDiffusion and Documentation/Theory.md, 5.3.
 */
class CellSpread : public PhotonShares
{
public:
  /// `sides`: 2, or 1 where light spreads over both sides together.
  explicit CellSpread(int sides)
    : sides_(sides)
  {
  }

  /// Finds the weights for a scene and its sums. They are a function of these alone; where nothing
  /// but rigid motion has happened since the last call, most are kept.
  ///
  /// `photons`: on how many photons the estimate of a small cell is to draw, on the average of its
  /// object. `quantaPerWalk`: in all bands together.
  void update(const SceneObjects& objects, const CellSums& sums, std::size_t rounds, double photons,
    double quantaPerWalk, Execution& execution)
  {
    const CancelPoint cancelPoint = cancelPointOf(execution, 0);
    objects_.resize(objects.size());
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      ObjectCells& cells = objects_[object];
      measure(objects[object], cells, cancelPoint);
      const std::int64_t quanta = quantaOn(object, sums, rounds, cancelPoint);
      for (cells.shift = 0; quanta >> cells.shift >= std::int64_t{ 1 } << 53;)
      {
        ++cells.shift;
      }
      const double received = static_cast<double>(quanta) / quantaPerWalk;
      connect(cells, spreadWidth(photons, cells.area, received), cancelPoint);
    }
    if (sums.plan().replicates().count() > 1)
    {
      findPhotonShares(execution);
    }
  }

  /// What the first `rounds` rounds brought, spread over the cells of the scene of the last update;
  /// replicate by replicate, in one round.
  /// What cells gathered stays where it is. Where more than 2^53 quanta arrived, the lowest bits of
  /// each sum stay where they are.
  CellSums spread(const SceneObjects& objects, const CellSums& sums, std::size_t rounds,
    Execution& execution) const
  {
    const std::uint32_t walks = sums.plan().walksAfter(rounds);
    const std::uint32_t replicates = sums.plan().replicates().count();
    const auto bands = static_cast<std::uint32_t>(objects.staticObject.material->bands);
    CellSums result(objects, WalkPlan(walks, walks, replicates), 0, sums.gatherers(), sides_);
    result.setRounds(1, cancelPointOf(execution, 0));
    std::vector<DiffusingFields> all;
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      addFields(objects_[object].diffusion, object, std::size_t{ replicates } * bands, all);
    }
    const auto begin = [&](DiffusingFields& fields) {
      const unsigned shift = objects_[fields.object].shift;
      fields.quanta.resize(objects[fields.object].material->numberOfCells *
        static_cast<std::size_t>(sides_) * fields.width());
      bool isDark = true;
      const auto read = [&](const CellSide& cell, int band, auto replicate, std::size_t i) {
        const std::int64_t sum = sums.shot(cell, band, replicate, rounds);
        fields.quanta[i] = static_cast<double>(sum >> shift);
        isDark = isDark && sum == 0;
      };
      forEachSum(fields, bands, read);
      fields.stepsDone = isDark ? fields.diffusion->steps() : 0;
    };
    const auto end = [&](const DiffusingFields& fields) {
      const unsigned shift = objects_[fields.object].shift;
      const std::int64_t lowest = (std::int64_t{ 1 } << shift) - 1;
      const auto write = [&](const CellSide& cell, int band, auto replicate, std::size_t i) {
        const std::int64_t low = shift == 0 ? 0 : sums.shot(cell, band, replicate, rounds) & lowest;
        const auto spread = static_cast<std::int64_t>(fields.quanta[i]);
        result.set(cell, band, replicate, (spread << shift) + low);
        if (sums.gathers(cell))
        {
          result.setGathered(cell, band, replicate, sums.gathered(cell, band, replicate, rounds));
        }
      };
      forEachSum(fields, bands, write);
    };
    diffuse(all, begin, end, execution);
    return result;
  }

  /// If the cells around expect equally many photons for their area. Known to within a third or so,
  /// and only if the sums of the update had replicates.
  double photonShare(const CellSide& cell) const override
  {
    const ObjectCells& cells = objects_[cell.object];
    return cells.photonShares.empty()
      ? 1.0
      : cells.photonShares[cell.cell * static_cast<std::size_t>(sides_) +
          (sides_ == 2 ? static_cast<std::size_t>(cell.side) : 0)];
  }

private:
  /// A map that stretches as `linear` does. Poses that differ by a rigid motion, and by rounding,
  /// have the same one, so that areas and edges need not be measured again.
  static Matrix3 shapeOf(const Matrix3& linear)
  {
    constexpr int kBits = 40;
    Matrix3 squares = linear.transpose() * linear;
    if (!(squares.diagonal().minCoeff() > 0))
    {
      return linear;
    }
    // 0.7 keeps the steps of rounding from changing at the length that is most frequent, 1.
    const auto exponent = [&](int i) { return std::ilogb(squares(i, i) / 0.7); };
    const Eigen::Array3i exponents(exponent(0), exponent(1), exponent(2));
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        const double step = std::ldexp(1.0, (exponents[i] + exponents[j]) / 2 - kBits);
        squares(i, j) = step * std::nearbyint(squares(i, j) / step);
      }
    }
    const Eigen::LLT<Matrix3> roots(squares);
    return roots.info() == Eigen::Success ? Matrix3(roots.matrixU()) : linear;
  }
  /// The cells of an object, and how power flows between them.
  struct ObjectCells
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    Matrix3 shape;             ///< see shapeOf()
    std::vector<double> areas; ///< m2
    double area = 0;           ///< of all cells
    unsigned shift = 0;        ///< halvings that take what it received below 2^53 quanta
    double width = -1;         ///< m2; < 0: not connected yet
    CellDiffusion diffusion;
    std::vector<float> photonShares; ///< of the nodes; empty: not known, or all are 1
  };

  static void measure(const SceneObject& object, ObjectCells& cells, const CancelPoint& cancelPoint)
  {
    const Matrix3 shape = shapeOf(object.worldFromObject.linear);
    if (cells.body != object.body || cells.material != object.material || cells.shape != shape)
    {
      SceneObject unturned = object;
      unturned.worldFromObject = { shape, Vector3::Zero() };
      unturned.isPresent = true; // it has the same areas when it comes back
      cells = {};
      cells.areas = cellAreas(unturned, cancelPoint);
      cells.area = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
      cells.body = object.body;
      cells.material = object.material;
      cells.shape = shape;
    }
  }
  /// What an object received.
  std::int64_t quantaOn(std::uint32_t object, const CellSums& sums, std::size_t rounds,
    const CancelPoint& cancelPoint) const
  {
    ThrottledCancelPoint pace(cancelPoint);
    const Material& material = *objects_[object].material;
    std::int64_t quanta = 0;
    for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
    {
      for (int band = 0; band < material.bands; ++band)
      {
        for (std::uint32_t i = 0; i < sums.plan().replicates().count(); ++i)
        {
          quanta += sums.shot({ { object, cell } }, band, i, rounds);
          pace.step(2 * rounds);
        }
      }
    }
    return quanta;
  }
  void connect(ObjectCells& cells, double width, const CancelPoint& cancelPoint) const
  {
    if (cells.width == width)
    {
      return;
    }
    cells.photonShares.clear();
    cells.width = -1; // until all is known
    std::vector<Triangle> triangles;
    triangles.reserve(cells.body->mesh().triangles().size());
    ThrottledCancelPoint pace(cancelPoint);
    for (const Triangle& triangle : cells.body->mesh().triangles())
    {
      triangles.push_back(transformed({ cells.shape, Vector3::Zero() }, triangle));
      pace.step();
    }
    cells.diffusion = surfaceDiffusion(
      cells.areas, triangles, cells.material->cellOfTriangle, sides_, width, cancelPoint);
    cells.width = width;
  }
  void findPhotonShares(Execution& execution)
  {
    std::vector<ObjectCells*> unknown;
    std::vector<std::pair<const std::vector<double>*, const CellDiffusion*>> surfaces;
    for (ObjectCells& cells : objects_)
    {
      if (cells.diffusion.steps() > 0 && cells.photonShares.empty())
      {
        unknown.push_back(&cells);
        surfaces.emplace_back(&cells.areas, &cells.diffusion);
      }
    }
    std::vector<std::vector<float>> shares = photonShares(surfaces, sides_, execution);
    for (std::size_t i = 0; i < unknown.size(); ++i)
    {
      unknown[i]->photonShares = std::move(shares[i]);
    }
  }
  /// Calls visit(cell side, band, replicate, index into the quanta) for all sums in the fields.
  /// Each replicate of an object has a field for each band.
  template <class Visit>
  void forEachSum(const DiffusingFields& fields, std::uint32_t bands, const Visit& visit) const
  {
    const ObjectCells& cells = objects_[fields.object];
    const auto object = static_cast<std::uint32_t>(fields.object);
    std::size_t node = 0;
    for (SceneCell cell{ object, 0 }; cell.cell < cells.areas.size(); ++cell.cell)
    {
      forEachSide(cell, sides_ == 2, [&](const CellSide& side) {
        const std::size_t place = fields.placeOf(node++);
        for (std::uint32_t k = 0; k < fields.count; ++k)
        {
          const std::uint32_t field = fields.first + k;
          visit(side, static_cast<int>(field % bands), field / bands, place + k);
        }
      });
    }
  }

  int sides_;
  std::vector<ObjectCells> objects_;
};

}
