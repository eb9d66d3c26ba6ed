#include "SegmentScan.h"

#include "SimdLevel.h"
#include "SimdTarget.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace irradiance
{

namespace
{

/// What the loops read and write.
struct Points
{
  const float *x, *y, *z;
  const std::uint16_t* tags;
  std::size_t segments; ///< one less than points
  std::uint8_t* isNamed;
};

/// Written for the compiler to turn into SIMD instructions: no branch, no call.
__attribute__((always_inline)) inline void nameByTag(const Points& points, std::uint32_t tags)
{
  const std::uint16_t* const __restrict tag = points.tags;
  std::uint8_t* const __restrict isNamed = points.isNamed;
  const std::size_t count = points.segments;
  for (std::size_t i = 0; i < count; ++i)
  {
    isNamed[i] =
      static_cast<std::uint8_t>(tags >> (std::uint32_t{ tag[i] } >> WalkBlock::kTagShift) & 1u);
  }
}

/// a * b + c, in one instruction where there is one. How it is rounded matters to no answer here.
template <bool hasFma>
__attribute__((always_inline)) inline float mulAdd(float a, float b, float c)
{
  if constexpr (hasFma)
  {
    return __builtin_fmaf(a, b, c);
  }
  return a * b + c;
}

template <bool hasFma>
__attribute__((always_inline)) inline float dot(
  float ax, float ay, float az, float bx, float by, float bz, float c)
{
  return mulAdd<hasFma>(ax, bx, mulAdd<hasFma>(ay, by, mulAdd<hasFma>(az, bz, c)));
}

/// With p and p + q the ends, a the squared length and t the place nearest to 0, the distance from 0
/// is below r if t (t a + 2 p.q) + p.p < r^2; here times a, so that nothing is divided.
template <bool hasFma>
__attribute__((always_inline)) inline void nameNear(
  const Points& points, const SegmentScan::Body& body)
{
  const float *const __restrict x = points.x, *const __restrict y = points.y,
                     *const __restrict z = points.z;
  const SegmentScan::Body b = body;
  std::uint8_t* const __restrict isNamed = points.isNamed;
  const std::size_t count = points.segments;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], dz = z[i + 1] - z[i];
    const float px =
      dot<hasFma>(b.matrix[0], b.matrix[3], b.matrix[6], x[i], y[i], z[i], b.offset[0]);
    const float py =
      dot<hasFma>(b.matrix[1], b.matrix[4], b.matrix[7], x[i], y[i], z[i], b.offset[1]);
    const float pz =
      dot<hasFma>(b.matrix[2], b.matrix[5], b.matrix[8], x[i], y[i], z[i], b.offset[2]);
    const float qx = dot<hasFma>(b.matrix[0], b.matrix[3], b.matrix[6], dx, dy, dz, 0);
    const float qy = dot<hasFma>(b.matrix[1], b.matrix[4], b.matrix[7], dx, dy, dz, 0);
    const float qz = dot<hasFma>(b.matrix[2], b.matrix[5], b.matrix[8], dx, dy, dz, 0);
    const float length = dot<hasFma>(qx, qy, qz, qx, qy, qz, 0);
    const float along = dot<hasFma>(px, py, pz, qx, qy, qz, 0);
    const float outside = dot<hasFma>(px, py, pz, px, py, pz, -b.squaredRadius);
    const float back = along > -length ? along : -length;
    const float nearest = back < 0 ? back : 0;
    const float gap =
      mulAdd<hasFma>(nearest, mulAdd<hasFma>(-2.0F, along, nearest), length * outside);
    isNamed[i] |= static_cast<std::uint8_t>(gap > 0 ? 0 : 1);
  }
}

template <bool hasFma>
__attribute__((always_inline)) inline void name(
  const Points& points, std::uint32_t tags, const std::vector<SegmentScan::Body>& bodies)
{
  nameByTag(points, tags);
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    nameNear<hasFma>(points, bodies[i]);
  }
}

void namePlain(
  const Points& points, std::uint32_t tags, const std::vector<SegmentScan::Body>& bodies)
{
  name<false>(points, tags, bodies);
}

#ifdef __x86_64__
IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)
void nameAvx2(
  const Points& points, std::uint32_t tags, const std::vector<SegmentScan::Body>& bodies)
{
  name<true>(points, tags, bodies);
}
IRRADIANCE_TARGET_END

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX512)
void nameAvx512(
  const Points& points, std::uint32_t tags, const std::vector<SegmentScan::Body>& bodies)
{
  name<true>(points, tags, bodies);
}
IRRADIANCE_TARGET_END
#endif

}

SegmentScan::SegmentScan(const UnitFrame& frame, double reach)
  : frame_(frame)
  , reach_(reach)
  , namesAll_(!(reach <= kLargestReach))
{
}

void SegmentScan::addBody(const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const Matrix3 matrix = ball.roundFromWorld / frame_.scale;
  const Vector3 offset = ball.roundFromWorld * (frame_.center - ball.center);
  // No point is farther from 0. Floats are off by 2^-24 of each number in a sum of a few, squares of
  // lengths by that of the squares; Documentation/Theory.md counts them.
  const double farthest = 2 * reach_ * matrix.norm() + offset.norm();
  const double radius = ball.radius + 0x1p-20 * farthest;
  Body body;
  Eigen::Map<Eigen::Matrix3f>(body.matrix) = matrix.cast<float>();
  Eigen::Map<Eigen::Vector3f>(body.offset) = offset.cast<float>();
  body.squaredRadius =
    static_cast<float>((radius * radius + 0x1p-18 * farthest * farthest) * (1 + 0x1p-20));
  // Beyond these, a product of floats might overflow, or vanish.
  constexpr double kMost = 1e6, kLeast = 1e-6;
  const double stretch = matrix.norm();
  namesAll_ = namesAll_ || bodies_.size() == kMostBodies || !(stretch < kMost) ||
    !(stretch > kLeast) || !(farthest < kMost);
  bodies_.push_back(body);
}

void SegmentScan::find(const WalkBlock& block, std::vector<std::uint32_t>& points) const
{
  points.clear();
  const std::size_t segments = std::max<std::size_t>(block.numberOfPoints(), 1) - 1;
  if (namesAll_)
  {
    for (std::uint32_t i = 0; i < segments; ++i)
    {
      points.push_back(i);
    }
    return;
  }
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  static thread_local std::vector<std::uint8_t> isNamed;
  isNamed.assign((segments + kWord) / kWord * kWord, 0);
  const Points all{ block.x(), block.y(), block.z(), block.tags(), segments, isNamed.data() };
#ifdef __x86_64__
  const SimdLevel level = simdLevel();
  (level == SimdLevel::Avx512    ? nameAvx512
      : level == SimdLevel::Avx2 ? nameAvx2
                                 : namePlain)(all, tags_, bodies_);
#else
  namePlain(all, tags_, bodies_);
#endif
  for (std::size_t word = 0; word < isNamed.size(); word += kWord)
  {
    std::uint64_t eight;
    std::memcpy(&eight, isNamed.data() + word, kWord);
    for (std::size_t i = word; eight != 0 && i < word + kWord; ++i)
    {
      if (isNamed[i] != 0)
      {
        points.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
}

}
