// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/PolygonTriangulation.h"

#include "Meshes/FlatPolygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

// The edges are forced into a Delaunay triangulation of the corners. Each edge then adds one to the
// winding number on its left, so an edge walked there and back adds nothing. A flood fill from
// outside finds for every triangle how often the polygon goes around it.
//
// CGAL's predicates are exact, so touching is recognised as such. Where edges cross, the fast
// kernel gives up, and one with exact points of intersection starts again.

namespace irradiance
{
namespace
{

using Corners = std::vector<Vector3>;

/// Relative to the polygon's size. Less overlap is touching, as corners may be rounded to float.
constexpr double kTouching = 0x1p-20;
/// Relative to its width. If bent by more, edges need not intersect where they seem to cross.
constexpr double kBent = 0x1p-4;
/// The largest number of points of intersection that are computed.
constexpr std::size_t kMostCrossings = 1000;
constexpr std::size_t kNoCorner = std::numeric_limits<std::size_t>::max();
constexpr int kUnknown = std::numeric_limits<int>::min();

/// The triangles of a polygon, and whether it is free of crossings.
struct Pieces
{
  std::vector<Triangle> triangles;
  bool isSimple = true;
};

struct VertexInfo
{
  std::size_t corner = kNoCorner; ///< the first of the corners at this vertex
};

struct FaceInfo
{
  int winding = kUnknown;
  std::array<int, 3> step{}; ///< how much higher the winding number is than beyond edge i
};

template <class Kernel, class IntersectionTag>
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<
    CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>,
    CGAL::Constrained_triangulation_face_base_2<Kernel,
      CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>>,
  IntersectionTag>;

using FastDelaunay = Delaunay<CGAL::Exact_predicates_inexact_constructions_kernel,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;
/// The "plus" variant intersects whole edges, not parts of edges that end at other intersections.
using ExactDelaunay = CGAL::Constrained_triangulation_plus_2<
  Delaunay<CGAL::Exact_predicates_exact_constructions_kernel, CGAL::Exact_intersections_tag>>;

double toDouble(double x)
{
  return x;
}

template <class Exact>
double toDouble(const CGAL::Lazy_exact_nt<Exact>& x)
{
  return CGAL::to_double(x.exact());
}

template <class Triangulation>
class PolygonCutter
{
public:
  PolygonCutter(const Corners& corners, const std::vector<Vector2>& flat)
    : corners_(corners)
  {
    points_.reserve(flat.size());
    for (const Vector2& point : flat)
    {
      points_.emplace_back(point.x(), point.y());
    }
  }

  /// Nothing if there are too many crossings.
  std::optional<Pieces> cut()
  {
    insertCorners();
    if (triangulation_.dimension() < 2)
    {
      return Pieces{};
    }
    if (!insertEdges())
    {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < corners_.size(); ++i)
    {
      countEdge(i);
    }
    spreadWinding();
    return pieces();
  }

private:
  using Kernel = typename Triangulation::Geom_traits;
  using Point = typename Triangulation::Point;
  using Vertex = typename Triangulation::Vertex_handle;
  using Face = typename Triangulation::Face_handle;

  /// In an order in which neighbours are close but earlier points are not all on one side.
  void insertCorners()
  {
    std::vector<std::size_t> order(points_.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    using Map = typename CGAL::Pointer_property_map<Point>::type;
    CGAL::spatial_sort(order.begin(), order.end(),
      CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(CGAL::make_property_map(points_)));
    vertices_.resize(points_.size());
    Face hint;
    for (const std::size_t i : order)
    {
      const Vertex vertex = triangulation_.insert(points_[i], hint);
      vertex->info().corner = std::min(vertex->info().corner, i);
      vertices_[i] = vertex;
      hint = vertex->face();
    }
  }

  Vertex endOfEdge(std::size_t i) const { return vertices_[(i + 1) % vertices_.size()]; }

  bool insertEdges()
  {
    const std::size_t most = triangulation_.number_of_vertices() + kMostCrossings;
    for (std::size_t i = 0; i < vertices_.size(); ++i)
    {
      if (vertices_[i] != endOfEdge(i))
      {
        triangulation_.insert_constraint(vertices_[i], endOfEdge(i));
      }
      if (triangulation_.number_of_vertices() > most)
      {
        return false;
      }
    }
    return true;
  }

  /// Walks along the parts of edge i and counts each for the triangles on both sides.
  void countEdge(std::size_t i)
  {
    const Vertex end = endOfEdge(i);
    Vertex from = vertices_[i], to;
    Face face;
    int side = 0;
    for (; from != end && triangulation_.includes_edge(from, end, to, face, side); from = to)
    {
      if (to->info().corner == kNoCorner)
      {
        addCrossing(i, to);
      }
      const bool isLeft = face->vertex(triangulation_.ccw(side)) == from;
      const int step = isLeft ? 1 : -1;
      face->info().step[static_cast<std::size_t>(side)] += step;
      const int mirror = triangulation_.mirror_index(face, side);
      face->neighbor(side)->info().step[static_cast<std::size_t>(mirror)] -= step;
    }
  }

  /// Adds a new corner, on edge i.
  void addCrossing(std::size_t i, Vertex vertex)
  {
    const std::size_t next = (i + 1) % corners_.size();
    const auto across = points_[next] - points_[i], along = vertex->point() - points_[i];
    const bool isSteep = CGAL::abs(across.y()) > CGAL::abs(across.x());
    const double t = isSteep ? toDouble(along.y() / across.y()) : toDouble(along.x() / across.x());
    vertex->info().corner = corners_.size() + crossings_.size();
    crossings_.push_back(corners_[i] + t * (corners_[next] - corners_[i]));
  }

  void spreadWinding()
  {
    triangulation_.infinite_face()->info().winding = 0;
    std::vector<Face> reached{ triangulation_.infinite_face() };
    while (!reached.empty())
    {
      const Face face = reached.back();
      reached.pop_back();
      for (int side = 0; side < 3; ++side)
      {
        const Face neighbor = face->neighbor(side);
        if (neighbor->info().winding == kUnknown)
        {
          neighbor->info().winding =
            face->info().winding - face->info().step[static_cast<std::size_t>(side)];
          reached.push_back(neighbor);
        }
      }
    }
  }

  const Vector3& position(Vertex vertex) const
  {
    const std::size_t corner = vertex->info().corner;
    return corner < corners_.size() ? corners_[corner] : crossings_[corner - corners_.size()];
  }

  Pieces pieces() const
  {
    Pieces result;
    const double width = kTouching * extent();
    for (const Face face : triangulation_.finite_face_handles())
    {
      const int winding = face->info().winding;
      const bool isOnceAtMost = winding == 0 || winding == 1;
      result.isSimple = result.isSimple && (isOnceAtMost || height(face) <= width);
    }
    for (const Face face : triangulation_.finite_face_handles())
    {
      const int winding = face->info().winding;
      const bool isInside = result.isSimple ? winding > 0 : winding != 0;
      if (isInside && height(face) > kLineWidth)
      {
        result.triangles.push_back(
          { position(face->vertex(0)), position(face->vertex(1)), position(face->vertex(2)) });
      }
    }
    return result;
  }

  double extent() const
  {
    Eigen::AlignedBox2d box;
    for (const Point& point : points_)
    {
      box.extend(flat(point));
    }
    return box.sizes().maxCoeff();
  }

  /// The height over the longest side.
  static double height(Face face)
  {
    const Vector2 a = flat(face->vertex(0)->point());
    const Vector2 b = flat(face->vertex(1)->point()) - a;
    const Vector2 c = flat(face->vertex(2)->point()) - a;
    return std::abs(b.x() * c.y() - b.y() * c.x()) /
      std::max({ b.norm(), c.norm(), (c - b).norm() });
  }

  static Vector2 flat(const Point& point) { return { toDouble(point.x()), toDouble(point.y()) }; }

  const Corners& corners_;
  std::vector<Point> points_;    ///< of the corners
  std::vector<Vertex> vertices_; ///< of the corners
  Corners crossings_;
  Triangulation triangulation_;
};

std::optional<Pieces> cut(const Corners& corners, const std::vector<Vector2>& flat)
{
  try
  {
    return PolygonCutter<FastDelaunay>(corners, flat).cut();
  }
  catch (const FastDelaunay::Intersection_of_constraints_exception&)
  {
    return PolygonCutter<ExactDelaunay>(corners, flat).cut();
  }
}

Pieces cutPolygon(const Corners& corners)
{
  const Corners unit = inUnitFrame(corners);
  const Vector3 front = frontOf(unit);
  if (front.isZero(0))
  {
    return {};
  }
  if (corners.size() == 4 && !isPlanar(unit, front, kBent))
  {
    return { cutFan(corners), true };
  }
  const std::vector<Vector2> flat = seenAlongAxis(unit, front);
  if (isConvex(flat))
  {
    return { cutConvex(corners), true };
  }
  std::optional<Pieces> pieces = cut(corners, flat);
  if (pieces && !pieces->isSimple && !isPlanar(unit, front, kTouching))
  {
    std::optional<Pieces> fromFront = cut(corners, seenFromFront(unit, front));
    if (fromFront && fromFront->isSimple)
    {
      return *fromFront;
    }
    if (!isPlanar(unit, front, kBent))
    {
      pieces.reset();
    }
  }
  return pieces ? *pieces : Pieces{ cutFan(corners), false };
}

}

bool triangulate(const std::vector<Vector3>& corners, std::vector<Triangle>& triangles)
{
  std::optional<std::vector<Triangle>> few;
  if (corners.size() <= 3)
  {
    few = cutFan(corners);
  }
  else if (corners.size() == 4)
  {
    few = cutQuad(corners);
  }
  const Pieces pieces = few ? Pieces{ std::move(*few), true } : cutPolygon(corners);
  triangles.insert(triangles.end(), pieces.triangles.begin(), pieces.triangles.end());
  return pieces.isSimple;
}

}
