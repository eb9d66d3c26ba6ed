#include "CellField.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace irradiance;

namespace
{

/// The areas of all cells, and `value(object, cell, area)` of each.
template <class Value>
CellField fieldOf(const SceneObjects& objects, const Value& value)
{
  CellField field;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      field.push_back(value(object, cell, areas[cell]));
    }
  }
  return field;
}

}

CellField areasOf(const SceneObjects& objects)
{
  return fieldOf(objects, [](std::uint32_t, std::size_t, double area) { return area; });
}

CellField irradianceOf(const IrradianceEngine& engine, const SceneObjects& objects)
{
  return fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double area) {
    return engine.irradiance(object, cell, 0, 0, area);
  });
}

CellField standardErrorOf(const IrradianceEngine& engine, const SceneObjects& objects)
{
  const ErrorEstimate errors = engine.errorEstimate();
  return fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double area) {
    return engine.watts(errors.standardError(object, cell, 0, 0)) / area;
  });
}

double meanOf(const CellField& field, const CellField& areas)
{
  return std::inner_product(field.begin(), field.end(), areas.begin(), 0.0) /
    std::accumulate(areas.begin(), areas.end(), 0.0);
}

double rmsError(const CellField& field, const CellField& truth, const CellField& areas)
{
  CellField squares;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    squares.push_back((field[i] - truth[i]) * (field[i] - truth[i]));
  }
  return std::sqrt(meanOf(squares, areas)) / meanOf(truth, areas);
}

double worstError(const CellField& field, const CellField& truth, const CellField& areas)
{
  double worst = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    worst = std::max(worst, std::abs(field[i] - truth[i]));
  }
  return worst / meanOf(truth, areas);
}

CellField coarsened(const CellField& field, int levels)
{
  CellField coarse = field;
  for (int level = 0; level < levels; ++level)
  {
    for (std::size_t i = 0; i < coarse.size() / 4; ++i)
    {
      coarse[i] =
        0.25 * (coarse[4 * i] + coarse[4 * i + 1] + coarse[4 * i + 2] + coarse[4 * i + 3]);
    }
    coarse.resize(coarse.size() / 4);
  }
  return coarse;
}

double quantileOf(const CellField& field, const CellField& areas, double share)
{
  std::vector<std::size_t> order(field.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return field[a] < field[b]; });
  double left = share * std::accumulate(areas.begin(), areas.end(), 0.0);
  for (const std::size_t i : order)
  {
    left -= areas[i];
    if (left <= 0)
    {
      return field[i];
    }
  }
  return field[order.back()];
}
