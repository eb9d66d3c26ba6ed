// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonSet.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

std::vector<SegmentRef> sorted(const PhotonSet& set)
{
  std::vector<SegmentRef> photons;
  set.forEach([&](const SegmentRef& photon) { photons.push_back(photon); });
  std::sort(photons.begin(), photons.end());
  return photons;
}

/// A PhotonSet and what it should be.
struct Pair
{
  PhotonSet set;
  std::set<SegmentRef> model;

  void insert(const SegmentRef& photon)
  {
    if (model.insert(photon).second)
    {
      set.insert(photon);
    }
  }
  void remove(const SegmentRef& photon)
  {
    if (model.erase(photon) != 0)
    {
      set.remove(photon);
    }
  }
  void expectEqual() const
  {
    ASSERT_EQ(set.size(), model.size());
    ASSERT_EQ(sorted(set), std::vector<SegmentRef>(model.begin(), model.end()));
  }
};

using Random = std::mt19937_64;

/// Operations on photons of few walks, so that they meet again and again. The set grows and shrinks
/// by turns.
void compareWithModel(std::uint64_t seed)
{
  Random random(seed);
  const auto walks = static_cast<std::uint32_t>(1 + random() % 1000);
  const auto bounces = static_cast<std::uint32_t>(1 + random() % 6);
  Pair pair;
  for (std::uint32_t step = 0; step < scaled(24000); ++step)
  {
    const SegmentRef photon{ static_cast<std::uint32_t>(random() % walks),
      static_cast<std::uint32_t>(random() % bounces) };
    const unsigned insertions = step / 3000 % 2 == 0 ? 3 : 1; // of 4 operations
    if (random() % 4 < insertions)
    {
      pair.insert(photon);
    }
    else
    {
      pair.remove(photon);
    }
    ASSERT_EQ(pair.set.contains(photon), pair.model.count(photon) != 0);
    if (step % 500 == 0)
    {
      ASSERT_NO_FATAL_FAILURE(pair.expectEqual()) << "step " << step;
    }
  }
  ASSERT_NO_FATAL_FAILURE(pair.expectEqual());
}

/// Inserts all, looks for each, and removes them in another order.
void insertAndRemove(const std::vector<SegmentRef>& photons)
{
  Pair pair;
  for (const SegmentRef& photon : photons)
  {
    pair.insert(photon);
  }
  ASSERT_NO_FATAL_FAILURE(pair.expectEqual());
  for (std::size_t i = 0; i < photons.size(); ++i)
  {
    const SegmentRef& photon = photons[i * 7919 % photons.size()];
    ASSERT_TRUE(pair.set.contains(photon));
    pair.remove(photon);
    ASSERT_FALSE(pair.set.contains(photon));
    if (i % 64 == 0)
    {
      ASSERT_NO_FATAL_FAILURE(pair.expectEqual());
    }
  }
  ASSERT_NO_FATAL_FAILURE(pair.expectEqual());
}

double bytesAPhoton(const PhotonSet& set)
{
  return double(sizeof(set) + set.bytes()) / double(set.size());
}

TEST(PhotonSet, AgreesWithAStandardSetUnderRandomOperations)
{
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
  {
    ASSERT_NO_FATAL_FAILURE(compareWithModel(seed)) << "seed " << seed;
  }
}

TEST(PhotonSet, HoldsRegularSequencesOfPhotons)
{
  constexpr std::uint32_t kLast = 0xfffffffeu; // the largest number of a walk
  std::vector<std::vector<SegmentRef>> sequences(6);
  for (std::uint32_t i = 0; i < 3000; ++i)
  {
    sequences[0].push_back({ i, 0 });
    sequences[1].push_back({ 7, i });
    sequences[2].push_back({ kLast - i, (1u << 20) - 1 });
    sequences[3].push_back({ i << 20, 0 });
    sequences[4].push_back({ i, i });
    sequences[5].push_back({ kLast, kLast + 1 - i });
  }
  for (const std::vector<SegmentRef>& photons : sequences)
  {
    ASSERT_NO_FATAL_FAILURE(insertAndRemove(photons)) << "walk " << photons[1].walk;
  }
}

TEST(PhotonSet, MemoryFollowsTheNumberOfPhotons)
{
  constexpr std::uint32_t kMost = 10000;
  PhotonSet set;
  EXPECT_EQ(set.bytes(), 0u);
  EXPECT_LE(sizeof(set), 24u);
  double sum = 0;
  int resized = 0;
  for (std::uint32_t i = 0; i < kMost; ++i)
  {
    const std::size_t before = set.bytes();
    set.insert({ i, i % 5 });
    resized += set.bytes() == before ? 0 : 1;
    sum += bytesAPhoton(set);
    ASSERT_TRUE(i < 10 || bytesAPhoton(set) <= 24) << i;
  }
  EXPECT_LE(sum / kMost, 12);
  // A table of several buckets grows by 1.2 at least: 40 times from 8 photons to 10,000.
  EXPECT_LE(resized, 4 + 40);
  // At least half of the slots are in use, a bucket aside.
  while (set.size() > 0)
  {
    const std::size_t size = set.size();
    ASSERT_LE(set.bytes(), sizeof(SegmentRef) * (2 * size + 8)) << size;
    const auto last = static_cast<std::uint32_t>(size - 1);
    set.remove({ last, last % 5 });
  }
  EXPECT_EQ(set.bytes(), 0u);
}

}
}
