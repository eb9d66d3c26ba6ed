// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Sampling/SobolNet.h"
#include "Sampling/SobolSequence.h"

namespace irradiance::test
{
namespace
{

constexpr SampleUse kUses[] = { SampleUse::Light, SampleUse::Position, SampleUse::Direction,
  SampleUse::Survival };

/// Sobol's point as the xor of direction numbers m_k 2^(32 - k) (Bratley and Fox 1988).
std::uint32_t fromDirectionNumbers(std::uint32_t index, const std::array<std::uint32_t, 32>& m)
{
  std::uint32_t point = 0;
  for (std::uint32_t k = 0; k < 32; ++k)
  {
    point ^= (index >> k & 1u) != 0 ? m[k] << (31 - k) : 0u;
  }
  return point;
}

/// Whether every elementary interval of 2^-a by 2^-(m - a) holds exactly one of 2^m points.
template <class Point>
bool isNet(int m, const Point& point)
{
  const std::uint32_t size = 1u << m;
  for (int a = 0; a <= m; ++a)
  {
    std::vector<int> counts(size, 0);
    for (std::uint32_t i = 0; i < size; ++i)
    {
      const std::array<double, 2> u = point(i);
      const auto column = static_cast<std::uint32_t>(std::ldexp(u[0], a));
      const auto row = static_cast<std::uint32_t>(std::ldexp(u[1], m - a));
      if (++counts[column << (m - a) | row] > 1)
      {
        return false;
      }
    }
  }
  return true;
}

/// Chi-square of pairs in 16 x 16 squares.
class PairCounts
{
public:
  void add(double u, double v)
  {
    ++total_;
    ++counts_[static_cast<std::size_t>(16 * u) * 16 + static_cast<std::size_t>(16 * v)];
  }
  double chiSquare() const
  {
    double sum = 0;
    for (const double count : counts_)
    {
      sum += (count - total_ / 256) * (count - total_ / 256) / (total_ / 256);
    }
    return sum;
  }

private:
  double total_ = 0;
  std::array<double, 256> counts_{};
};

// Exceeded by chance once in 10^6 tests.
const double kLimit = chiSquareLimit(255, 4.753);

TEST(SobolSequence, FirstTwoDimensionsFollowTheDirectionNumbers)
{
  std::array<std::uint32_t, 32> first{}, second{};
  for (std::size_t k = 0; k < 32; ++k)
  {
    first[k] = 1;
    second[k] = k == 0 ? 1 : second[k - 1] << 1 ^ second[k - 1]; // primitive polynomial x + 1
  }
  std::mt19937 random(1);
  for (std::uint32_t i = 0; i < 200000; ++i)
  {
    const auto index = i < 100000 ? i : static_cast<std::uint32_t>(random());
    ASSERT_EQ(SobolPoint::reversed(index), fromDirectionNumbers(index, first)) << index;
    ASSERT_EQ(SobolPoint::reversed(SobolPoint::pascal(index)), fromDirectionNumbers(index, second))
      << index;
  }
}

TEST(SobolSequence, EveryBlockOfTwoToTheMIsANet)
{
  for (const std::uint64_t seed : { 0ull, 1ull, 0x123456789abcdefull })
  {
    const SobolSequence samples(seed);
    for (const std::uint32_t bounce : { 0u, 1u, 2u, 17u, 1000000u })
    {
      for (const SampleUse use : kUses)
      {
        for (int m = 0; m <= 10; ++m)
        {
          for (const std::uint32_t block : { 0u, 1u, 5u, 0x3fffffu })
          {
            ASSERT_TRUE(isNet(
              m, [&](std::uint32_t i) { return samples.sample((block << m) + i, bounce, use); }))
              << "seed " << seed << ", bounce " << bounce << ", use " << int(use) << ", block "
              << block << " of 2^" << m;
          }
        }
      }
    }
  }
}

TEST(SobolSequence, ValuesAreOddMultiplesOfTheHalfStep)
{
  const SobolSequence samples(7);
  for (std::uint32_t walk = 0; walk < 300000; ++walk)
  {
    for (const double u : samples.sample(walk * 14321u, walk % 7, kUses[walk % 4]))
    {
      ASSERT_GT(u, 0);
      ASSERT_LT(u, 1);
      ASSERT_EQ(std::fmod(std::ldexp(u, 33), 2.0), 1.0) << u;
    }
  }
}

// One walk under many seeds: bounces and uses are independent. 24 tests: a false alarm once in
// 40,000 choices of the hash.
TEST(SobolSequence, BouncesAndUsesAreIndependentUnderManySeeds)
{
  for (const std::uint32_t walk : { 0u, 1u, 4095u, 123456u })
  {
    std::array<PairCounts, 6> pairs;
    for (std::uint64_t seed = 0; seed < 65536; ++seed)
    {
      const SobolSequence samples(seed);
      const auto a = samples.sample(walk, 0, SampleUse::Direction);
      const auto b = samples.sample(walk, 1, SampleUse::Direction);
      const auto c = samples.sample(walk, 0, SampleUse::Position);
      const auto d = samples.sample(walk, 1, SampleUse::Survival);
      pairs[0].add(a[0], a[1]);
      pairs[1].add(a[0], b[0]);
      pairs[2].add(a[1], b[1]);
      pairs[3].add(a[0], c[0]);
      pairs[4].add(b[0], d[0]);
      pairs[5].add(a[0], SobolSequence(seed + 1).sample(walk, 0, SampleUse::Direction)[0]);
    }
    for (const PairCounts& pair : pairs)
    {
      EXPECT_LT(pair.chiSquare(), kLimit) << "walk " << walk;
    }
  }
}

// One walk of one seed, along its bounces. A false alarm once in 300,000.
TEST(SobolSequence, SuccessiveBouncesAreIndependent)
{
  const SobolSequence samples(1);
  std::array<PairCounts, 3> pairs;
  for (std::uint32_t bounce = 0; bounce < 65536; ++bounce)
  {
    const auto a = samples.sample(3, bounce, SampleUse::Direction);
    pairs[0].add(a[0], a[1]);
    pairs[1].add(a[0], samples.sample(3, bounce + 1, SampleUse::Direction)[0]);
    pairs[2].add(a[1], samples.sample(3, bounce + 1, SampleUse::Survival)[0]);
  }
  for (const PairCounts& pair : pairs)
  {
    EXPECT_LT(pair.chiSquare(), kLimit);
  }
}

// Each replicate follows a net of its own, the first the net of the seed.
TEST(SobolSequence, ReplicatesAreSequencesOfTheirOwn)
{
  constexpr std::uint32_t kReplicates = 5;
  const SobolSequence dealt(3, Replicates(kReplicates)), plain(3);
  std::set<std::array<double, 2>> firsts;
  for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate)
  {
    EXPECT_TRUE(isNet(8,
      [&](std::uint32_t i) {
        const auto u = dealt.sample(i * kReplicates + replicate, 2, SampleUse::Direction);
        EXPECT_TRUE(replicate > 0 || u == plain.sample(i, 2, SampleUse::Direction));
        return u;
      }))
      << "replicate " << replicate;
    firsts.insert(dealt.sample(replicate, 2, SampleUse::Direction));
  }
  EXPECT_EQ(firsts.size(), kReplicates);
}

// Pairs of replicates, walk by walk, are distributed like pairs of independent numbers.
TEST(SobolSequence, ReplicatesAreIndependent)
{
  constexpr std::uint32_t kReplicates = 16;
  std::array<PairCounts, 3> pairs; // neighbours; distant ones; the last and the next seed's first
  for (std::uint64_t seed = 1; seed <= 2000; ++seed)
  {
    const SobolSequence samples(seed, Replicates(kReplicates)),
      next(seed + 1, Replicates(kReplicates));
    const std::uint32_t walk = (seed % 61) * kReplicates;
    const auto first = [&](std::uint32_t replicate) {
      return samples.sample(walk + replicate, 0, SampleUse::Direction)[0];
    };
    for (std::uint32_t i = 0; i + 1 < kReplicates; ++i)
    {
      pairs[0].add(first(i), first(i + 1));
    }
    pairs[1].add(first(0), first(9));
    pairs[2].add(first(15), next.sample(walk, 0, SampleUse::Direction)[0]);
  }
  for (const PairCounts& pair : pairs)
  {
    EXPECT_LE(pair.chiSquare(), kLimit);
  }
}

/// How many binary digits after the point two numbers in [0, 1) share from the first on.
int sharedDigits(double u, double v)
{
  int digits = 0;
  while (
    digits < 20 && std::floor(std::ldexp(u, digits + 1)) == std::floor(std::ldexp(v, digits + 1)))
  {
    ++digits;
  }
  return digits;
}

/// Scrambling keeps how many leading digits two points share. The points are those of Joe and Kuo's
/// page, in the order of Gray's code; the fourth coordinate follows from their direction numbers 1,
/// 3, 1, 5.
TEST(SobolNet, HasThePointsOfJoeAndKuo)
{
  const std::vector<SobolNet::Point> published = { { 0, 0, 0, 0 }, { 0.5, 0.5, 0.5, 0.5 },
    { 0.75, 0.25, 0.25, 0.25 }, { 0.25, 0.75, 0.75, 0.75 }, { 0.375, 0.375, 0.625, 0.875 },
    { 0.875, 0.875, 0.125, 0.375 }, { 0.625, 0.125, 0.875, 0.625 }, { 0.125, 0.625, 0.375, 0.125 },
    { 0.1875, 0.3125, 0.9375, 0.4375 }, { 0.6875, 0.8125, 0.4375, 0.9375 } };
  const auto gray = [](std::uint32_t i) { return i ^ i >> 1; };
  for (std::uint64_t seed = 0; seed < 8; ++seed)
  {
    const SobolNet net(splitMix(seed));
    for (std::uint32_t i = 0; i < published.size(); ++i)
    {
      for (std::uint32_t j = 0; j < i; ++j)
      {
        const SobolNet::Point a = net.inUnitCube(gray(i)), b = net.inUnitCube(gray(j));
        for (std::size_t k = 0; k < a.size(); ++k)
        {
          EXPECT_EQ(sharedDigits(a[k], b[k]), sharedDigits(published[i][k], published[j][k]))
            << "points " << i << " and " << j << ", coordinate " << k;
        }
      }
    }
  }
}

/// In each coordinate 2^m points that follow each other stand in all of 2^m strata, wherever they
/// begin.
TEST(SobolNet, FillsTheStrataOfEachCoordinate)
{
  for (std::uint64_t seed = 0; seed < 4; ++seed)
  {
    const SobolNet net(splitMix(seed));
    for (const std::uint32_t size : { 64u, 1024u, 65536u })
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        std::vector<bool> strata(size, false);
        for (std::uint32_t i = 0; i < size; ++i)
        {
          strata[static_cast<std::size_t>(net.inUnitCube(3 * size + i)[k] * size)] = true;
        }
        EXPECT_TRUE(std::all_of(strata.begin(), strata.end(), [](bool is) { return is; }))
          << size << " points, coordinate " << k;
      }
    }
  }
}

/// It is a (3, m, 4)-net: of 2048 points each of 4 x 4 x 4 x 4 boxes has 8.
TEST(SobolNet, FillsAllFourDimensionsTogether)
{
  for (std::uint64_t seed = 0; seed < 16; ++seed)
  {
    const SobolNet net(splitMix(seed));
    std::vector<int> counts(256, 0);
    for (std::uint32_t i = 0; i < 2048; ++i)
    {
      std::size_t box = 0;
      for (const double u : net.inUnitCube(2048 * static_cast<std::uint32_t>(seed) + i))
      {
        ASSERT_GT(u, 0);
        ASSERT_LT(u, 1);
        box = 4 * box + static_cast<std::size_t>(4 * u);
      }
      ++counts[box];
    }
    EXPECT_EQ(counts, std::vector<int>(256, 8));
  }
}

/// Of 4096 seeds, the first point's coordinates are even and independent: the mean of each and of
/// each product is off by more than 5 standard errors in one run of 170,000.
TEST(SobolNet, IsScrambledEvenly)
{
  constexpr int kSeeds = 4096;
  std::array<double, 4> sums{};
  double products = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
  {
    const SobolNet::Point point = SobolNet(splitMix(seed)).inUnitCube(0);
    for (std::size_t k = 0; k < 4; ++k)
    {
      sums[k] += point[k] - 0.5;
    }
    products += (point[0] - 0.5) * (point[1] - 0.5) + (point[2] - 0.5) * (point[3] - 0.5);
  }
  for (const double sum : sums)
  {
    EXPECT_LT(std::abs(sum), 5 * std::sqrt(kSeeds / 12.0));
  }
  EXPECT_LT(std::abs(products), 5 * std::sqrt(2 * kSeeds / 144.0));
}

}
}
