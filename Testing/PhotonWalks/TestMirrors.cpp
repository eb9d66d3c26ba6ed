// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

namespace irradiance::test
{
namespace
{

const double kRho = 0.5;

/// The walls of 0 <= x <= 2, each one cell, without the wall at x = 0; a lamp below the ceiling and
/// a box on one side. With `isMirrored` all of it at -x.
void addHalf(ObjectBuilder& builder, bool isMirrored)
{
  const auto at = [&](double x, double y, double z) { return Vector3(isMirrored ? -x : x, y, z); };
  // A mirrored quad faces the other way, so its sides are swapped.
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c, const Look& look) {
    isMirrored ? builder.addQuad(a, c - a, b - a, 1, 1, look)
               : builder.addQuad(a, b - a, c - a, 1, 1, look);
  };
  const Look wall = grey(kRho);
  add(at(0, 0, 0), at(2, 0, 0), at(0, 3, 0), wall);
  add(at(0, 0, 2.5), at(0, 3, 2.5), at(2, 0, 2.5), wall);
  add(at(2, 0, 0), at(2, 0, 2.5), at(2, 3, 0), wall);
  add(at(0, 0, 0), at(0, 0, 2.5), at(2, 0, 0), wall);
  add(at(0, 3, 0), at(2, 3, 0), at(0, 3, 2.5), wall);
  add(at(1.2, 0.5, 2.4), at(1.2, 1.3, 2.4), at(1.8, 0.5, 2.4), grey(0, 10));
  const double near = isMirrored ? 1.3 : 0.8, far = isMirrored ? 0.8 : 1.3;
  builder.addBox(box(at(near, 1.8, 0.4), at(far, 2.2, 0.9)), 1, wall);
}

constexpr std::size_t kCellsOfHalf = 12; ///< of a half

/// Watts on the cells of the half at x >= 0, from 16 seeds of 65,536 walks for each lamp: 10^6.
std::vector<ReplicateMean> wattsOfHalf(const SceneObjects& objects, std::uint32_t lamps)
{
  std::vector<ReplicateMean> watts(kCellsOfHalf);
  overSeeds(objects, 16, Shoot(lamps * scaled(65536)), [&](const IrradianceEngine& engine) {
    for (std::size_t cell = 0; cell < kCellsOfHalf; ++cell)
    {
      watts[cell].add(wattsOn(engine, 0, cell, cell + 1));
    }
  });
  return watts;
}

// A room with a perfect mirror for a wall equals the doubled room with the mirrored lamp. 12 cells,
// |t| > 4 of some 30 degrees of freedom: a false alarm in 0.5 %; |t| > 3 and 1 % for the six walls.
TEST(Mirrors, ARoomWithAMirrorEqualsTheDoubledRoom)
{
  ObjectBuilder mirrored, doubled;
  addHalf(mirrored, false);
  Look mirror;
  mirror.specular = { 1, 1, 1 };
  mirrored.addQuad({ 0, 0, 0 }, { 0, 3, 0 }, { 0, 0, 2.5 }, 1, 1, mirror);
  addHalf(doubled, false);
  addHalf(doubled, true);
  const auto with = wattsOfHalf({ mirrored.build(), {} }, 1);
  const auto twice = wattsOfHalf({ doubled.build(), {} }, 2);
  for (std::size_t cell = 0; cell < kCellsOfHalf; ++cell)
  {
    const double difference = with[cell].mean() - twice[cell].mean();
    const double error = std::hypot(with[cell].standardError(), twice[cell].standardError());
    EXPECT_LE(std::abs(difference), (cell < 5 ? 3 : 4) * error);
    if (cell < 5 && !kIsSanitized)
    {
      EXPECT_NEAR(difference, 0, 0.01 * twice[cell].mean());
    }
  }
}

}
}
