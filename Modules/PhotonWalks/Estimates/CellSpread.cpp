// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellSpread.h"

#include "Execution/SlicedPass.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <random>

namespace irradiance
{

namespace
{

/// A map that stretches as `linear` does. Poses that differ by a rigid motion, and by rounding, have
/// the same one, so that areas and edges need not be measured again.
Matrix3 shapeOf(const Matrix3& linear)
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

/// To three bits behind the leading one, downwards.
double rounded(double x)
{
  constexpr int kBits = 4;
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, kBits)), exponent - kBits);
}

}

void CellSpread::measure(
  const SceneObject& object, ObjectCells& cells, const CancelPoint& cancelPoint)
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

std::int64_t CellSpread::quantaOn(std::uint32_t object, const CellSums& sums, std::size_t rounds,
  const CancelPoint& cancelPoint) const
{
  ThrottledCancelPoint pace(cancelPoint);
  const Material& material = *objects_[object].material;
  std::int64_t quanta = 0;
  for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
  {
    for (int side = 0; side < sums.sides(); ++side)
    {
      for (int band = 0; band < material.bands; ++band)
      {
        for (std::uint32_t i = 0; i < sums.plan().replicates().count(); ++i)
        {
          quanta += sums.sum({ object, cell, side }, band, i, rounds);
          pace.step(rounds);
        }
      }
    }
  }
  return quanta;
}

void CellSpread::connect(
  ObjectCells& cells, double width, int sides, const CancelPoint& cancelPoint)
{
  if (cells.width == width && cells.sides == sides)
  {
    return;
  }
  cells.diffusion = {};
  cells.photonShares.clear();
  cells.sides = 0; // until all is known
  if (std::any_of(
        cells.areas.begin(), cells.areas.end(), [&](double area) { return area < width; }))
  {
    cells.diffusion =
      CellDiffusion(cells.areas, neighboursOf(cells, width, cancelPoint), sides, width);
  }
  cells.width = width;
  cells.sides = sides;
}

std::vector<CellNeighbours> CellSpread::neighboursOf(
  const ObjectCells& cells, double width, const CancelPoint& cancelPoint)
{
  // On a cylinder of radius r a photon fills a shape sqrt(1 + 30 width / r^2) times as long as wide.
  // Of 10 to 100, no factor is better than the others by much.
  const double normalLength = std::sqrt(30 * width);
  const std::vector<Triangle>& model = cells.body->mesh().triangles();
  std::vector<Triangle> triangles;
  triangles.reserve(model.size());
  ThrottledCancelPoint pace(cancelPoint);
  for (const Triangle& triangle : model)
  {
    triangles.push_back(transformed({ cells.shape, Vector3::Zero() }, triangle));
    pace.step();
  }
  return cellNeighbours(triangles, cells.material->cellOfTriangle, cells.material->numberOfCells,
    normalLength, cancelPoint);
}

void CellSpread::update(const SceneObjects& objects, const CellSums& sums, std::size_t rounds,
  double photons, double quantaPerWalk, Execution& execution)
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
    const double width = received > 0 ? rounded(photons * cells.area / received) : 0.0;
    connect(cells, width, sums.sides(), cancelPoint);
  }
  if (sums.plan().replicates().count() > 1)
  {
    findPhotonShares(execution);
  }
}

void CellSpread::addFields(
  std::uint32_t object, std::uint32_t count, std::vector<Fields>& all) const
{
  for (std::uint32_t first = 0; first < count; first += CellDiffusion::kFields)
  {
    all.push_back({ object, first, std::min(count - first, CellDiffusion::kFields), {}, {} });
  }
}

template <class Begin, class End>
void CellSpread::diffuse(
  std::vector<Fields>& all, const Begin& begin, const End& end, Execution& execution) const
{
  SlicedPass pass{ all.size(), {} };
  pass.work = [&](std::size_t i, const Deadline& deadline) {
    Fields& fields = all[i];
    const CellDiffusion& diffusion = objects_[fields.object].diffusion;
    if (fields.quanta.empty())
    {
      begin(fields);
    }
    while (fields.stepsDone < diffusion.steps())
    {
      diffusion.step(fields.stepsDone, fields.width(), fields.quanta, fields.before);
      ++fields.stepsDone;
      if (deadline.hasPassed())
      {
        return false;
      }
    }
    end(fields);
    fields.quanta = fields.before = {};
    return true;
  };
  pass.run(execution);
}

template <class Visit>
void CellSpread::forEachSum(
  const Fields& fields, std::uint32_t bands, int sides, const Visit& visit) const
{
  const ObjectCells& cells = objects_[fields.object];
  std::size_t node = 0;
  for (CellSide cell{ { fields.object, 0 }, 0 }; cell.cell < cells.areas.size(); ++cell.cell)
  {
    for (cell.side = 0; cell.side < sides; ++cell.side)
    {
      const std::size_t place = cells.diffusion.placeOf(node++) * fields.width();
      for (std::uint32_t k = 0; k < fields.count; ++k)
      {
        const std::uint32_t field = fields.first + k;
        visit(cell, static_cast<int>(field % bands), field / bands, place + k);
      }
    }
  }
}

/// Where more than 2^53 quanta arrived, the lowest bits of each sum stay where they are.
CellSums CellSpread::spread(
  const SceneObjects& objects, const CellSums& sums, std::size_t rounds, Execution& execution) const
{
  const std::uint32_t walks = sums.plan().walksAfter(rounds);
  const std::uint32_t replicates = sums.plan().replicates().count();
  const auto bands = static_cast<std::uint32_t>(objects.staticObject.material->bands);
  CellSums result(objects, sums.sides(), WalkPlan(walks, walks, replicates), 0);
  result.setRounds(1, cancelPointOf(execution, 0));
  std::vector<Fields> all;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    addFields(object, replicates * bands, all);
  }
  const auto begin = [&](Fields& fields) {
    const unsigned shift = objects_[fields.object].shift;
    fields.quanta.resize(objects[fields.object].material->numberOfCells *
      static_cast<std::size_t>(sums.sides()) * fields.width());
    bool isDark = true;
    const auto read = [&](const CellSide& cell, int band, auto replicate, std::size_t i) {
      const std::int64_t sum = sums.sum(cell, band, replicate, rounds);
      fields.quanta[i] = static_cast<double>(sum >> shift);
      isDark = isDark && sum == 0;
    };
    forEachSum(fields, bands, sums.sides(), read);
    fields.stepsDone = isDark ? objects_[fields.object].diffusion.steps() : 0;
  };
  const auto end = [&](const Fields& fields) {
    const unsigned shift = objects_[fields.object].shift;
    const std::int64_t lowest = (std::int64_t{ 1 } << shift) - 1;
    const auto write = [&](const CellSide& cell, int band, auto replicate, std::size_t i) {
      const std::int64_t low = shift == 0 ? 0 : sums.sum(cell, band, replicate, rounds) & lowest;
      const auto spread = static_cast<std::int64_t>(fields.quanta[i]);
      result.set(cell, band, replicate, (spread << shift) + low);
    };
    forEachSum(fields, bands, sums.sides(), write);
  };
  diffuse(all, begin, end, execution);
  return result;
}

/// In quanta: in proportion to the square root of area, as large as their exact sum allows, if the
/// squares of all fields are to fit into an integer.
std::vector<std::int64_t> CellSpread::deviationsOf(const ObjectCells& cells)
{
  const auto nodes = static_cast<double>(cells.areas.size()) * cells.sides;
  const double most = std::min(0x1p28, 0x1p52 / nodes);
  const double largest = *std::max_element(cells.areas.begin(), cells.areas.end());
  std::vector<std::int64_t> deviations;
  for (const double area : cells.areas)
  {
    deviations.insert(deviations.end(), static_cast<std::size_t>(cells.sides),
      static_cast<std::int64_t>(most * std::sqrt(area / largest)));
  }
  return deviations;
}

void CellSpread::fillWithSigns(Fields& fields, const std::vector<std::int64_t>& sizes) const
{
  const CellDiffusion& diffusion = objects_[fields.object].diffusion;
  fields.quanta.resize(sizes.size() * fields.width());
  for (std::uint32_t k = 0; k < fields.count; ++k)
  {
    std::mt19937_64 random(fields.first + k);
    for (std::size_t node = 0; node < sizes.size(); ++node)
    {
      fields.quanta[diffusion.placeOf(node) * fields.width() + k] =
        static_cast<double>(random() % 2 == 0 ? sizes[node] : -sizes[node]);
    }
  }
}

/**
 * Of independent sums S_k with the variances A_k, cell i receives the sum of W_ik S_k. The variance of
 * that, in units of A_i, is the photon's share. It is measured with some fields of random signs.
 */
void CellSpread::findPhotonShares(Execution& execution)
{
  constexpr std::uint32_t kFields = 16;
  std::vector<std::vector<std::int64_t>> sizes(objects_.size()), squares(objects_.size());
  std::vector<Fields> all;
  for (std::uint32_t object = 0; object < objects_.size(); ++object)
  {
    const ObjectCells& cells = objects_[object];
    if (cells.diffusion.steps() > 0 && cells.photonShares.empty())
    {
      sizes[object] = deviationsOf(cells);
      squares[object].resize(sizes[object].size());
      addFields(object, kFields, all);
    }
  }
  const auto begin = [&](Fields& fields) { fillWithSigns(fields, sizes[fields.object]); };
  std::mutex mutex;
  const auto end = [&](const Fields& fields) {
    const CellDiffusion& diffusion = objects_[fields.object].diffusion;
    const std::lock_guard<std::mutex> lock(mutex);
    std::vector<std::int64_t>& sums = squares[fields.object];
    for (std::size_t node = 0; node < sums.size(); ++node)
    {
      for (std::uint32_t k = 0; k < fields.count; ++k)
      {
        const auto quanta =
          static_cast<std::int64_t>(fields.quanta[diffusion.placeOf(node) * fields.width() + k]);
        sums[node] += quanta * quanta;
      }
    }
  };
  diffuse(all, begin, end, execution);
  const auto share = [](std::int64_t size, std::int64_t sum) {
    const auto variance = static_cast<double>(size * size) * kFields;
    return size > 0 ? static_cast<float>(std::min(1.0, static_cast<double>(sum) / variance)) : 1.0F;
  };
  for (std::uint32_t object = 0; object < objects_.size(); ++object)
  {
    std::transform(sizes[object].begin(), sizes[object].end(), squares[object].begin(),
      std::back_inserter(objects_[object].photonShares), share);
  }
}

double CellSpread::photonShare(const CellSide& cell) const
{
  const ObjectCells& cells = objects_[cell.object];
  return cells.photonShares.empty()
    ? 1.0
    : cells.photonShares[cell.cell * static_cast<std::size_t>(cells.sides) +
        static_cast<std::size_t>(cell.side)];
}

}
