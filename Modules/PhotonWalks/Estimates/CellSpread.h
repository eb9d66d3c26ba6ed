// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellSpread_h
#define irradiance_CellSpread_h

#include "Estimates/ErrorEstimate.h"
#include "Estimates/SurfaceDiffusion.h"

#include <memory>
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
    double quantaPerWalk, Execution& execution);

  /// What the first `rounds` rounds brought, spread over the cells of the scene of the last update;
  /// replicate by replicate, in one round.
  CellSums spread(const SceneObjects& objects, const CellSums& sums, std::size_t rounds,
    Execution& execution) const;

  /// If the cells around expect equally many photons for their area. Known to within a third or so,
  /// and only if the sums of the update had replicates.
  double photonShare(const CellSide& cell) const override;

private:
  /// The cells of an object, and how power flows between them.
  struct ObjectCells
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    Matrix3 shape;             ///< see shapeOf() in the .cpp
    std::vector<double> areas; ///< m2
    double area = 0;           ///< of all cells
    unsigned shift = 0;        ///< halvings that take what it received below 2^53 quanta
    double width = -1;         ///< m2; < 0: not connected yet
    CellDiffusion diffusion;
    std::vector<float> photonShares; ///< of the nodes; empty: not known, or all are 1
  };

  static void measure(
    const SceneObject& object, ObjectCells& cells, const CancelPoint& cancelPoint);
  /// What an object received.
  std::int64_t quantaOn(std::uint32_t object, const CellSums& sums, std::size_t rounds,
    const CancelPoint& cancelPoint) const;
  void connect(ObjectCells& cells, double width, const CancelPoint& cancelPoint) const;
  void findPhotonShares(Execution& execution);
  /// Calls visit(cell side, band, replicate, index into the quanta) for all sums in the fields.
  /// Each replicate of an object has a field for each band.
  template <class Visit>
  void forEachSum(const DiffusingFields& fields, std::uint32_t bands, const Visit& visit) const;

  int sides_;
  std::vector<ObjectCells> objects_;
};

}

#endif
