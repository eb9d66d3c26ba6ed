// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/SurfaceDiffusion.h"
#include "Execution/Execution.h"
#include "Exposure/ReplicateSums.h"
#include "Geometry/Triangle.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace irradiance
{

/// The cells of a body.
struct ExposedSurface
{
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> cellOfTriangle;
  std::size_t numberOfCells = 0;
};

/// The exposure of a body's cells, or of one side of them: each with all bands, cell by cell.
struct ExposedSide
{
  std::vector<double>* exposure; ///< J/m2
  ReplicateSums* replicates;     ///< two or more
};

/// A spread in progress. Field 0 is the exposure, field 1 + r replicate r, each band by band.
class ExposureSpreading
{
public:
  ExposureSpreading(const ExposedSurface& surface, int bands, const std::vector<ExposedSide>& sides)
    : surface_(surface)
    , bands_(static_cast<std::size_t>(bands))
    , sides_(sides)
    , areas_(surface.numberOfCells)
  {
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    {
      areas_[surface.cellOfTriangle[i]] += surface.triangles[i].area();
    }
  }

  /// In the dark, or if all replicates are the same, nothing is known of photons, and nothing
  /// flows.
  void run(double photons, Execution& execution)
  {
    const CancelPoint cancelPoint = cancelPointOf(execution, 0);
    const double received = photonsReceived(cancelPoint);
    const double area = std::accumulate(areas_.begin(), areas_.end(), 0.0);
    diffusion_ = surfaceDiffusion(areas_, surface_.triangles, surface_.cellOfTriangle,
      static_cast<int>(sides_.size()), spreadWidth(photons, area, received), cancelPoint);
    if (diffusion_.steps() > 0)
    {
      const auto shares =
        photonShares({ { &areas_, &diffusion_ } }, static_cast<int>(sides_.size()), execution);
      setPhotons(shares.front(), received);
      spread(execution);
    }
  }

private:
  std::size_t nodes() const { return areas_.size() * sides_.size(); }
  std::size_t cellOf(std::size_t node) const { return node / sides_.size(); }
  const ExposedSide& sideOf(std::size_t node) const { return sides_[node % sides_.size()]; }
  double& value(std::size_t node, std::size_t field) const
  {
    const std::size_t i = cellOf(node) * bands_ + field % bands_;
    const ExposedSide& side = sideOf(node);
    return field < bands_ ? (*side.exposure)[i] : side.replicates->exposure(i, field / bands_ - 1);
  }
  double energy(std::size_t node, std::size_t field) const
  {
    return areas_[cellOf(node)] * value(node, field);
  }
  double energyIn(std::size_t band) const
  {
    double sum = 0;
    for (std::size_t node = 0; node < nodes(); ++node)
    {
      sum += energy(node, band);
    }
    return sum;
  }

  /// Of what a node received in all bands, J2.
  double variance(std::size_t node) const
  {
    const std::size_t replicates = sideOf(node).replicates->count();
    std::vector<double> energies(replicates);
    for (std::size_t field = bands_; field < bands_ * (1 + replicates); ++field)
    {
      energies[field / bands_ - 1] += energy(node, field);
    }
    return ReplicateSums::varianceOfMean(energies);
  }

  double photonsReceived(const CancelPoint& cancelPoint) const
  {
    ThrottledCancelPoint pace(cancelPoint);
    double sum = 0, variances = 0;
    for (std::size_t band = 0; band < bands_; ++band)
    {
      sum += energyIn(band);
    }
    for (std::size_t node = 0; node < nodes(); ++node)
    {
      variances += variance(node);
      pace.step();
    }
    return sum * sum / variances;
  }

  void setPhotons(const std::vector<float>& shares, double received)
  {
    for (std::size_t band = 0; band < bands_; ++band)
    {
      const double photon = energyIn(band) / received;
      for (std::size_t node = 0; node < nodes(); ++node)
      {
        if (shares[node] < 1)
        {
          const std::size_t cell = cellOf(node);
          sideOf(node).replicates->drawOnPhotons(
            cell * bands_ + band, shares[node] * photon / areas_[cell]);
        }
      }
    }
  }

  /// The power of two, J, of which a field has less than 2^52 in all.
  double quantumOf(std::size_t field) const
  {
    double sum = 0;
    for (std::size_t node = 0; node < nodes(); ++node)
    {
      sum += std::abs(energy(node, field));
    }
    return sum > 0 ? std::ldexp(1.0, std::ilogb(sum) - 51) : 1;
  }

  /// Calls visit(node, field, its index) for all that is in some fields.
  template <class Visit>
  void forEach(const DiffusingFields& fields, const Visit& visit) const
  {
    for (std::size_t node = 0; node < nodes(); ++node)
    {
      const std::size_t place = fields.placeOf(node);
      for (std::uint32_t k = 0; k < fields.count; ++k)
      {
        visit(node, std::size_t{ fields.first } + k, place + k);
      }
    }
  }

  /// Values that keep their quanta keep their bits.
  void spread(Execution& execution)
  {
    const std::size_t count = bands_ * (1 + sides_.front().replicates->count());
    std::vector<double> quantum(count);
    const auto quantaOf = [&](std::size_t node, std::size_t field) {
      return std::nearbyint(energy(node, field) / quantum[field]);
    };
    const auto begin = [&](DiffusingFields& fields) {
      for (std::size_t field = fields.first; field < fields.first + fields.count; ++field)
      {
        quantum[field] = quantumOf(field);
      }
      fields.quanta.resize(nodes() * fields.width());
      forEach(fields, [&](std::size_t node, std::size_t field, std::size_t i) {
        fields.quanta[i] = quantaOf(node, field);
      });
    };
    const auto end = [&](const DiffusingFields& fields) {
      forEach(fields, [&](std::size_t node, std::size_t field, std::size_t i) {
        if (fields.quanta[i] != quantaOf(node, field))
        {
          value(node, field) = fields.quanta[i] * quantum[field] / areas_[cellOf(node)];
        }
      });
    };
    std::vector<DiffusingFields> all;
    addFields(diffusion_, 0, count, all);
    diffuse(all, begin, end, execution);
  }

  const ExposedSurface& surface_;
  std::size_t bands_;
  const std::vector<ExposedSide>& sides_;
  std::vector<double> areas_; ///< m2
  CellDiffusion diffusion_;
};

/**
 * Spreads exposure over neighbouring cells, see CellDiffusion, so that a small cell draws on about
 * `photons` photons, on the average of the body. `sides`: both together, or front and back. Energy
 * is conserved, in each band and side, to within rounding. The result is a function of the sums
 * alone.
 *
 * A body received N = E^2 / V photons, for its energy E, J, and the sum V of its cells' variances:
 * n independent ones of equal energy give n, and what the same walk brings at several times counts
 * once. See Documentation/Theory.md, 5.5.
 */
inline void spreadExposure(const ExposedSurface& surface, int bands,
  const std::vector<ExposedSide>& sides, double photons, Execution& execution)
{
  ExposureSpreading(surface, bands, sides).run(photons, execution);
}

}
