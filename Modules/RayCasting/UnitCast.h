#ifndef irradiance_UnitCast_h
#define irradiance_UnitCast_h

#include "Ray.h"
#include "TriangleIntersection.h"
#include "TriangleTree.h"

namespace irradiance
{

/**
 * A search of one ray in one tree, as the kernels see it: in the tree's unit frame, begun where the
 * ray enters the tree's box, with a direction whose largest component is 1.
 *
 * Law: no leaf that holds the closest hit is skipped, and no triangle that the test in double would
 * accept is rejected. In the frame every coordinate is at most about 1, so that all rounding is
 * bounded by constants: positions on the ray are off by less than kBlur, see
 * Documentation/Theory.md.
 */
struct UnitCast
{
  static constexpr double kBlur = 0x1p-20;
  static constexpr double kEdgeBlur = 0x1p-16;
  static constexpr double kLeastBlur = 0x1p-46;
  /// What floats can tell ends at steeper directions and farther origins.
  static constexpr double kSmallestComponent = 0x1p-12;
  static constexpr double kLargestOrigin = 0x1p26;
  static constexpr double kFarthest = 4; ///< nothing is beyond, on a ray within the frame

  const TriangleTree* tree;
  // For floats; used only if isForFloats.
  alignas(16) float origin[4];
  alignas(16) float direction[4];
  alignas(16) float inverse[4];      ///< of the direction; the last is 1
  alignas(16) float originInverse[4]; ///< their product; the last is 0
  float limit;    ///< nothing behind it matters; goes down as hits are found
  float pad;      ///< the places where planes are passed may be off by half of this
  float edgeBlur;  ///< of an edge function, for each unit of its triangle's edges
  float leastBlur; ///< and besides
  float slack;    ///< a hit's distance may be off by this when the ray grazes
  unsigned octant;
  bool isForFloats;
  // For the plain search, which takes all in double.
  Vector3 exactOrigin;
  Vector3 exactDirection;
  double from;  ///< no hit comes before
  double entry; ///< distance of `origin` from `exactOrigin`
  double exactLimit;
  // The source's own.
  static constexpr std::uint32_t kNoJob = 0xffffffffu;
  std::uint32_t job = kNoJob;
  std::uint32_t shearedObject; ///< in whose space `sheared` is
  ShearedRay sheared;

  /// `bound`: distance of the best hit so far, in units of `direction`; `from`: there is none
  /// before. False if the ray misses the box.
  bool prepare(const TriangleTree& tree, const Vector3& origin, const Vector3& direction,
    double from, double bound);
  void setBound(double bound);

private:
  double rate_; ///< length in the frame of one unit of distance, by the largest component
};

/// Whose rays are searched: hands out searches and decides on the triangles found. All in double
/// and in plain code: the kernels only say where to look.
class CastSource
{
public:
  /// Prepares the next search; false if there is none.
  virtual bool next(UnitCast& cast) = 0;
  /// Tests a triangle and lowers the limit of the cast if it is hit.
  virtual void test(UnitCast& cast, std::uint32_t reference) = 0;

protected:
  ~CastSource() = default;
};

/// Runs all searches of the source, with the best instructions of the machine.
void runCasts(CastSource& source);

/// The kernels: the same hits.
void runCastsPlain(CastSource& source);
void runCastsAvx2(CastSource& source);
void runCastsAvx512(CastSource& source);
/// One search, all in double. For rays that floats cannot follow.
void runCastPlain(CastSource& source, UnitCast& cast);

}

#endif
