// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TreeQuery_h
#define irradiance_TreeQuery_h

#include "Geometry/Ray.h"
#include "Trees/TriangleTree.h"

#include <algorithm>

namespace irradiance
{

struct QueryRequest;

/**
 * A search of one ray in one tree, as the kernels see it: in the tree's unit frame, begun where the
 * ray enters the tree's box, with a direction whose largest component is 1.
 *
 * Law: no leaf that holds the closest hit is skipped, and no triangle that the test in double would
 * accept is rejected. In the frame every coordinate is at most about 1, so that all rounding is
 * bounded by constants: positions on the ray are off by less than kBlur, see
 * Documentation/Theory.md.
 */
struct TreeQuery
{
  static constexpr double kBlur = 0x1p-20;
  /// Of an edge function, for each unit of its triangle's edges, and besides.
  static constexpr double kEdgeBlur = 0x1p-16;
  static constexpr double kLeastBlur = 0x1p-46;
  /// Of a determinant, for each unit of its triangle's edges squared.
  static constexpr float kSizeBlur = 0x1p-19F;
  /// What floats can tell ends at steeper directions and farther origins.
  static constexpr double kSmallestComponent = 0x1p-12;
  static constexpr double kLargestOrigin = 0x1p26;
  static constexpr double kFarthest = 4; ///< nothing is beyond, on a ray within the frame

  const TriangleTree* tree;
  // For floats; used only if isForFloats.
  alignas(16) float origin[4];
  alignas(16) float direction[4];
  alignas(16) float inverse[4];       ///< of the direction
  alignas(16) float originInverse[4]; ///< their product
  double rate;           ///< length in the frame, by the largest component, of one unit of distance
  double entry;          ///< distance of `origin` from where the ray begins
  float limit;           ///< nothing behind it matters; goes down as hits are found
  float pad;             ///< the places where planes are passed may be off by half of this
  float edgeBlur;        ///< of an edge function, for each unit of its triangle's edges
  float leastBlur;       ///< and besides
  float slack;           ///< a hit's distance may be off by this when the ray grazes
  float margin;          ///< from a hit to the limit behind it
  std::uint32_t skipped; ///< the reference of the triangle that the ray leaves, or none
  unsigned octant;
  bool isForFloats;
  // For the plain search, which takes all in double.
  Vector3 exactOrigin;
  Vector3 exactDirection;
  double from; ///< no hit comes before
  double exactLimit;
  // The source's own.
  std::uint32_t job;
  bool isShared; ///< wants to be told of lower limits

  /// False if the ray misses the tree's box.
  bool prepare(const QueryRequest& request);
  /// With the places where planes are passed off by `padding`.
  void setMargins(double padding)
  {
    pad = static_cast<float>(2 * padding);
    slack = static_cast<float>(tree->slack() + kBlur);
    // Half a pad for a box's own place, two for its order; see Documentation/Theory.md.
    margin = slack + 3 * pad;
    edgeBlur = static_cast<float>(kEdgeBlur + 4 * tree->blur());
    leastBlur = static_cast<float>(kLeastBlur + 32 * tree->blur());
  }
  /// The limits that follow from a hit at this distance.
  void setBound(double bound)
  {
    exactLimit = bound * rate + tree->slack();
    if (isForFloats)
    {
      limit = static_cast<float>(std::min(bound * rate - entry + margin, kFarthest));
    }
  }
  /// A distance, in units of `direction`, behind which the best hit is not. With all of the margin:
  /// what is a trifle in this tree's frame may be more than all of another tree.
  double bound() const
  {
    return (isForFloats ? static_cast<double>(limit) + entry : exactLimit) / rate;
  }
};

/// What a search is asked for: a ray in the space of a tree.
struct QueryRequest
{
  const TriangleTree* tree;
  Vector3 origin;
  Vector3 direction;
  double from;           ///< no hit comes before, in units of `direction`
  double bound;          ///< the best hit so far
  std::uint32_t skipped; ///< see TreeQuery
  std::uint32_t job;     ///< the owner's number
  bool isShared;         ///< see TreeQuery
};

/// Whose rays are searched: hands out searches and decides on the triangles found. All in double
/// and in plain code: the kernels only say where to look.
class QuerySource
{
public:
  /// The next searches, `most` at most; returns their number, 0 at the end.
  virtual std::size_t next(QueryRequest* requests, std::size_t most) = 0;
  /// A shared search begins.
  virtual void begin(TreeQuery& query) = 0;
  /// One of these triangles is the closest hit of the search, if there is one.
  virtual void finish(
    const TreeQuery& query, const std::uint32_t* references, std::size_t count) = 0;
  /// Tests a triangle at once and lowers the limit of the query if it is hit.
  virtual void test(TreeQuery& query, std::uint32_t reference) = 0;
  /// The limit of a shared query has gone down.
  virtual void narrow(const TreeQuery& query) = 0;

protected:
  ~QuerySource() = default;
};

/// Runs all searches of the source, with the best instructions of the machine.
void runQueries(QuerySource& source);

/// The kernels: the same hits.
void runQueriesPlain(QuerySource& source);
void runQueriesAvx2(QuerySource& source);
void runQueriesAvx512(QuerySource& source);
/// One search, all in double. For rays that floats cannot follow.
void runQueryPlain(QuerySource& source, TreeQuery& query);

}

#endif
