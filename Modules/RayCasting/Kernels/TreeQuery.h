// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TreeQuery_h
#define irradiance_TreeQuery_h

#include "Geometry/Ray.h"
#include "Trees/KdBounds.h"
#include "Trees/TriangleTree.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

struct QueryRequest;

/**
 * A search of one ray in one tree, as the kernels see it: in the tree's unit frame, starting where
 * the ray enters the tree's box, with a direction whose largest component is 1.
 *
 * Law: no leaf that holds the closest hit is skipped, and no triangle that the test in double would
 * accept is rejected. In the frame every coordinate is at most about 1, so that constants bound all
 * rounding: positions on the ray are off by less than kBlur. Documentation/Theory.md, section 3,
 * derives these constants.
 */
struct TreeQuery
{
  static constexpr double kBlur = 0x1p-20;
  /// The error of an edge function is below kEdgeBlur * L + kLeastBlur; L = |edge1|_1 + |edge2|_1.
  static constexpr double kEdgeBlur = 0x1p-16;
  static constexpr double kLeastBlur = 0x1p-46;
  /// The error of a determinant is below kSizeBlur * L^2.
  static constexpr float kSizeBlur = 0x1p-19F;
  /// Floats are too coarse for directions with a smaller component, and for origins farther away.
  static constexpr double kSmallestComponent = 0x1p-12;
  static constexpr double kLargestOrigin = 0x1p26;
  static constexpr double kFarthest = 4; ///< no hit is farther, on a ray that starts in the frame
  /// A ray that starts this far from a plane, in the frame, and leaves it hits nothing behind it.
  static constexpr double kClearOfPlane = 0x1p-40;

  const TriangleTree* tree;
  // For floats; used only if isForFloats.
  alignas(16) float origin[4];
  alignas(16) float direction[4];
  alignas(16) float inverse[4];       ///< of the direction
  alignas(16) float originInverse[4]; ///< their product
  double rate;           ///< length in the frame, by the largest component, of one unit of distance
  double entry;          ///< distance of `origin` from the start of the ray, in the frame
  float limit;           ///< nothing behind it matters; decreases as hits are found
  float pad;             ///< twice the error of the distances at which the ray passes planes
  float edgeBlur;        ///< error of an edge function, per unit of edge length
  float leastBlur;       ///< the part of that error that does not depend on the triangle
  float slack;           ///< a hit's distance may be off by this when the ray grazes
  float margin;          ///< from a hit to the limit behind it
  std::uint32_t skipped; ///< the reference of the triangle that the ray leaves, or kNone
  /// If the ray leaves a triangle that lies in a plane across an axis: a box is behind the ray whose
  /// farthest bound on that axis, with this sign, is at most `behind`.
  float behind;
  float behindSign; ///< 0 or -0
  int behindAxis;
  unsigned octant;
  bool isForFloats;
  double exactLimit; ///< as `limit`, from the start of the ray, for a search in double
  // For the source; kernels leave them alone.
  std::uint32_t job;
  bool isShared; ///< the source wants to be told of lower limits

  /// Copies from the request what all searches need. `largest`: largest component of its direction.
  void set(const QueryRequest& request, double largest);
  /// No hit comes before this distance from the start of the ray, in the frame.
  double from(const QueryRequest& request) const;
  /// Sets what is behind the ray.
  void setBehind(const QueryRequest& request);
  /// `padding`: the error of the distances at which the ray passes planes.
  void setMargins(double padding)
  {
    pad = static_cast<float>(2 * padding);
    slack = static_cast<float>(tree->slack() + kBlur);
    // Half a pad for the entry of a box, two for its order; see Documentation/Theory.md.
    margin = slack + 3 * pad;
    edgeBlur = static_cast<float>(kEdgeBlur + 4 * tree->blur());
    leastBlur = static_cast<float>(kLeastBlur + 32 * tree->blur());
  }
  /// Sets the limits that follow from a hit at this distance.
  void setBound(double bound)
  {
    exactLimit = bound * rate + tree->slack();
    if (isForFloats)
    {
      limit = static_cast<float>(std::min(bound * rate - entry + margin, kFarthest));
    }
  }
  /// The best hit is not behind this distance, in units of the request's direction. It includes the
  /// whole margin: a rounding error in this tree's frame may exceed the size of another tree.
  double bound() const
  {
    return (isForFloats ? static_cast<double>(limit) + entry : exactLimit) / rate;
  }
};

/// Asks for a search: a ray in the space of a tree.
struct QueryRequest
{
  const TriangleTree* tree;
  Vector3 origin;
  Vector3 direction;
  double from;           ///< no hit comes before it, in units of `direction`
  double bound;          ///< distance of the best hit so far, in units of `direction`
  std::uint32_t skipped; ///< see TreeQuery
  std::uint32_t job;     ///< the source's number for the search
  bool isShared;         ///< see TreeQuery
};

inline void TreeQuery::set(const QueryRequest& request, double largest)
{
  tree = request.tree;
  skipped = request.skipped;
  job = request.job;
  isShared = request.isShared;
  rate = largest * tree->frame().scale;
}

inline void TreeQuery::setBehind(const QueryRequest& request)
{
  behind = -std::numeric_limits<float>::infinity();
  behindSign = 0;
  behindAxis = 0;
  if (const AxisPlane* plane = tree->planes().of(skipped))
  {
    const UnitFrame& frame = tree->frame();
    const double side = std::copysign(1.0, request.direction[plane->axis]);
    const double place = side * plane->place;
    const double origin =
      side * ((request.origin[plane->axis] - frame.center[plane->axis]) * frame.scale);
    behind = origin - place >= kClearOfPlane ? roundUp(place) : behind;
    behindSign = static_cast<float>(std::copysign(0.0, side));
    behindAxis = plane->axis;
  }
}

inline double TreeQuery::from(const QueryRequest& request) const
{
  return std::max(0.0, request.from * rate - tree->slack());
}

/// Owns the rays: hands out searches and confirms the triangles found, in double and in plain code.
/// The kernels only say where to look.
class QuerySource
{
public:
  /// Writes up to `most` searches; returns their number, 0 at the end.
  virtual std::size_t next(QueryRequest* requests, std::size_t most) = 0;
  /// A shared search begins.
  virtual void begin(TreeQuery& query) = 0;
  /// A search ends. Its closest hit, if not yet tested, is one of these triangles.
  virtual void finish(
    const TreeQuery& query, const std::uint32_t* references, std::size_t count) = 0;
  /// Tests a triangle at once and lowers the limit of the query if the ray hits it.
  virtual void test(TreeQuery& query, std::uint32_t reference) = 0;
  /// The limit of a shared query has gone down.
  virtual void narrow(const TreeQuery& query) = 0;

protected:
  ~QuerySource() = default;
};

/// Runs all searches of the source with the best instructions of the machine.
void runQueries(QuerySource& source);

/// The kernels. All find the same hits.
void runQueriesPlain(QuerySource& source);
void runQueriesAvx2(QuerySource& source);
void runQueriesAvx512(QuerySource& source);
/// Runs one search all in double, for rays that floats cannot follow. The tree must not be empty.
void runQueryExact(QuerySource& source, const QueryRequest& request);

}

#endif
