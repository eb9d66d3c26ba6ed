// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SobolSequence.h"

#include "Kit.h"

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

}
}
