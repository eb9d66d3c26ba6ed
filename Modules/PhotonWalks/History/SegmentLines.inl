// SPDX-License-Identifier: BSD-3-Clause
// No include guard: PageScan.inl includes this, between the marks of a kernel's target.

namespace irradiance
{
namespace
{

/**
 * The lines of the segments of a page, in whole numbers of 16 bits, of which vectors hold twice as
 * many as of floats: u, along a line, of length 2^15, and b x u, in LineBall's unit, with b where
 * the segment begins. So
 * |b x u - c x u| is how far the line passes from c. Documentation/Theory.md derives what pays for rounding.
 */
struct SegmentLines
{
  alignas(64) std::int16_t along[3][BouncePage::kSize];
  alignas(64) std::int16_t moment[3][BouncePage::kSize];
};

/// A function of its own: within others, GCC 12 makes no SIMD of it.
__attribute__((noinline)) void findLines(
  const BouncePage& page, const float* stretch, SegmentLines& lines)
{
  constexpr float kOne = 32768, kMost = 32767, kPerUnit = 1 / LineBall::kUnit;
  constexpr float kShortest = 0x1p-20F; // squared; only a segment without length is shorter
  const float stretchX = stretch[0], stretchY = stretch[1], stretchZ = stretch[2];
  for (std::size_t i = 0; i < BouncePage::kSize; ++i)
  {
    const float bx = stretchX * page.ends[0][i], by = stretchY * page.ends[1][i],
                bz = stretchZ * page.ends[2][i];
    const float x = bx - stretchX * page.ends[3][i], y = by - stretchY * page.ends[4][i],
                z = bz - stretchZ * page.ends[5][i];
    const float square = x * x + y * y + z * z;
    const float perLength = 1 / __builtin_sqrtf(square > kShortest ? square : kShortest);
    const float ux = x * perLength, uy = y * perLength, uz = z * perLength;
    const auto whole = [](float value) {
      return static_cast<std::int16_t>(static_cast<std::int32_t>(value < kMost ? value : kMost));
    };
    lines.along[0][i] = whole(kOne * ux);
    lines.along[1][i] = whole(kOne * uy);
    lines.along[2][i] = whole(kOne * uz);
    lines.moment[0][i] = whole(kPerUnit * (by * uz - bz * uy));
    lines.moment[1][i] = whole(kPerUnit * (bz * ux - bx * uz));
    lines.moment[2][i] = whole(kPerUnit * (bx * uy - by * ux));
  }
}

/// Lists which lines may pass through which balls, from `place` on; apart for each of kParts parts
/// of these lines, with as much room as there are bodies.
template <class Shorts, std::size_t kParts>
inline void listNearLines(const SegmentLines& lines, std::size_t place, const GridBodies& all,
  NearBody* near, std::uint32_t (&counts)[kParts])
{
  constexpr std::size_t kLines = Shorts::kCount / kParts;
  constexpr unsigned kAll = (1u << kLines) - 1;
  const auto ux = Shorts::load(lines.along[0] + place), uy = Shorts::load(lines.along[1] + place),
             uz = Shorts::load(lines.along[2] + place), mx = Shorts::load(lines.moment[0] + place),
             my = Shorts::load(lines.moment[1] + place), mz = Shorts::load(lines.moment[2] + place);
  for (std::uint32_t body = 0; body < all.count; ++body)
  {
    const LineBall& ball = all.balls[body].line;
    const auto x = Shorts::all(ball.center[0]), y = Shorts::all(ball.center[1]),
               z = Shorts::all(ball.center[2]);
    const auto off = [](auto moment, auto a, auto ub, auto b, auto ua) {
      return Shorts::absolute(
        Shorts::add(Shorts::subtract(moment, Shorts::multiply(a, ub)), Shorts::multiply(b, ua)));
    };
    const auto farthest = Shorts::most(
      Shorts::most(off(mx, y, uz, z, uy), off(my, z, ux, x, uz)), off(mz, x, uy, y, ux));
    // Few are near, and it cannot be foreseen which: there is no branch.
    const unsigned passing = Shorts::notAbove(farthest, Shorts::all(ball.radius));
    for (std::size_t part = 0; part < kParts; ++part)
    {
      const unsigned some = passing >> part * kLines & kAll;
      near[part * all.count + counts[part]] = { body, some };
      counts[part] += some != 0 ? 1 : 0;
    }
  }
}

}
}
