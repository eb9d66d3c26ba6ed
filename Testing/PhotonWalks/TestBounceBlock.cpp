// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestMeshes.h"
#include "BounceFront.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

// Law: a block answers what a plain list of segments for each walk would answer, after any appends
// and removals, and holds little more than 32 bytes a segment.

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kFirst = 5 * 1024;

/// What was stored of a walk.
struct StoredEntry
{
  BounceSegment segment;
  std::uint32_t slot;
};
using StoredEntries = std::vector<StoredEntry>;

/// Applies the same operations to a block and to its model.
class Twins
{
public:
  Twins(unsigned seed, std::uint32_t walks, int bands)
    : random_(seed)
    , bands_(bands)
    , arena_(BounceBlock::pageBytes(bands))
    , model_(walks)
  {
    blocks_.emplace_back(arena_, kFirst, walks, bands,
      PointGrid(Box{ Vector3::Constant(-1), Vector3::Constant(1) }), onePower());
  }

  /// One more segment for each walk of a random share of them; in any order with `isMixed`.
  void append(double share, bool isMixed = false)
  {
    std::vector<BounceSegment> segments;
    for (std::uint32_t walk = 0; walk < model_.size(); ++walk)
    {
      if (uniform() < share)
      {
        const auto& before = model_[walk];
        segments.push_back(segment(walk, before.empty() ? BounceBlock::kNone : before.back().slot));
      }
    }
    if (isMixed)
    {
      std::shuffle(segments.begin(), segments.end(), random_);
    }
    BounceFront front;
    for (const BounceSegment& segment : segments)
    {
      front.add(segment);
    }
    const std::vector<std::uint32_t> slots = front.appendTo(block());
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      model_[front[i].walk - kFirst].push_back({ front[i], slots[i] });
    }
  }

  /// A random tail of each walk of a random share of them; all of it with `isWhole`.
  void remove(double share, bool isWhole)
  {
    for (auto& walk : model_)
    {
      if (!walk.empty() && uniform() < share)
      {
        const std::size_t first = isWhole ? 0 : random_() % walk.size();
        if (uniform() < 0.5)
        {
          block().removeFrom(walk[first].slot);
        }
        else
        {
          removeAndVisit(walk, first);
        }
        walk.resize(first, {});
      }
    }
  }

  void renumber()
  {
    const auto numberOf = [](std::uint32_t triangle) { return triangle / 2; };
    block().renumber(numberOf);
    for (auto& walk : model_)
    {
      for (StoredEntry& entry : walk)
      {
        std::uint32_t& triangle = entry.segment.triangle;
        triangle = triangle == BounceBlock::kNone ? triangle : numberOf(triangle);
      }
    }
  }

  /// Moves the block to other memory.
  void move() { blocks_.reserve(blocks_.capacity() + 1); }

  void expectEqual() const
  {
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < model_.size(); ++i)
    {
      ASSERT_NO_FATAL_FAILURE(expectEqualWalk(i));
      for (const StoredEntry& entry : model_[i])
      {
        used.push_back(entry.slot);
      }
    }
    std::sort(used.begin(), used.end());
    std::vector<std::uint32_t> visited;
    block().forEach([&](std::uint32_t slot) { visited.push_back(slot); });
    ASSERT_EQ(visited, used);
  }

  BounceBlock& block() { return blocks_.front(); }
  const BounceBlock& block() const { return blocks_.front(); }
  const BlockArena& arena() const { return arena_; }
  std::size_t segments() const
  {
    return std::accumulate(model_.begin(), model_.end(), std::size_t{ 0 },
      [](std::size_t sum, const StoredEntries& walk) { return sum + walk.size(); });
  }

private:
  static Power onePower()
  {
    Power power;
    power[0] = 1234567;
    return power;
  }
  /// Each segment is visited while all are there.
  void removeAndVisit(const StoredEntries& walk, std::size_t first)
  {
    std::size_t at = first;
    block().removeFrom(walk[first].slot, [&](std::uint32_t slot) {
      ASSERT_LT(at, walk.size());
      ASSERT_EQ(slot, walk[at].slot);
      ASSERT_NO_FATAL_FAILURE(expectEqualSegment(slot, walk[at].segment));
      if (at < 100 || at + 1 == walk.size())
      {
        ASSERT_EQ(block().bounceOf(slot), at);
      }
      ++at;
    });
    ASSERT_EQ(at, walk.size());
  }
  double uniform() { return std::uniform_real_distribution<double>()(random_); }

  BounceSegment segment(std::uint32_t walk, std::uint32_t parent)
  {
    BounceSegment segment;
    for (int axis = 0; axis < 3; ++axis)
    {
      segment.origin[axis] = 2 * uniform() - 1;
      segment.direction[axis] = static_cast<float>(2 * uniform() - 1);
      segment.power[axis] = axis < bands_ ? static_cast<std::int64_t>(random_() >> 2) : 0;
    }
    segment.walk = kFirst + walk;
    segment.parent = parent;
    if (uniform() < 0.8)
    {
      segment.distance = uniform();
      segment.triangle = static_cast<std::uint32_t>(random_() % BounceBlock::kNone);
      segment.weights = { static_cast<float>(uniform()), static_cast<float>(uniform()) };
      segment.kind = uniform() < 0.1
        ? BounceColumns::kContact
        : BounceTag::kindOf(static_cast<std::uint32_t>(random_() % 1000));
    }
    segment.isFront = uniform() < 0.5;
    return segment;
  }

  void expectEqualWalk(std::uint32_t i) const
  {
    const auto& walk = model_[i];
    const std::uint32_t number = kFirst + i;
    ASSERT_EQ(block().begin(number), walk.empty() ? BounceBlock::kNone : walk.front().slot);
    ASSERT_EQ(block().lastOf(number), walk.empty() ? BounceBlock::kNone : walk.back().slot);
    std::uint32_t before = BounceBlock::kNone, slot = block().begin(number);
    for (std::uint32_t bounce = 0; bounce < walk.size(); ++bounce)
    {
      ASSERT_EQ(slot, walk[bounce].slot);
      ASSERT_EQ(block().previous(slot), before);
      ASSERT_NO_FATAL_FAILURE(expectEqualSegment(slot, walk[bounce].segment));
      const bool isCounted = walk.size() < 100 || bounce % 997 == 0; // what follows counts links
      if (isCounted)
      {
        ASSERT_EQ(block().slotOf({ number, bounce }), slot);
        ASSERT_EQ(block().segmentAt(slot), (SegmentRef{ number, bounce }));
      }
      before = slot;
      slot = block().next(slot);
    }
    ASSERT_EQ(slot, BounceBlock::kNone);
    ASSERT_EQ(block().slotOf({ number, static_cast<std::uint32_t>(walk.size()) }), slot);
  }

  void expectEqualSegment(std::uint32_t slot, const BounceSegment& segment) const
  {
    ASSERT_FALSE(block().isFree(slot));
    ASSERT_EQ(block().walkOf(slot), segment.walk);
    ASSERT_EQ(block().triangle(slot), segment.triangle);
    ASSERT_EQ(block().weights(slot), segment.weights);
    ASSERT_EQ(block().isFront(slot), segment.isFront);
    ASSERT_EQ(block().isContact(slot), segment.kind == BounceColumns::kContact);
    ASSERT_EQ(block().tag(slot) & BounceTag::kKinds, segment.kind);
    ASSERT_TRUE(block().power(slot) == (bands_ > 1 ? segment.power : onePower()));
    const Vector3 along = segment.distance * segment.direction.cast<double>();
    const Vector3 end = segment.origin + along;
    const bool isWhole = segment.distance < kInfinity &&
      block().grid()(end).cwiseAbs().maxCoeff() <= PointGrid::kReach;
    ASSERT_EQ((block().tag(slot) & BounceTag::kOpen) == 0, isWhole);
  }

  std::mt19937_64 random_;
  int bands_;
  BlockArena arena_;
  std::vector<BounceBlock> blocks_; ///< one
  std::vector<StoredEntries> model_;
};

/// Some thousand segments at a time are appended, removed and stored anew.
void compareWithModel(unsigned seed, std::uint32_t walks, int bands, int steps)
{
  Twins twins(seed, walks, bands);
  std::mt19937_64 random(seed);
  std::size_t most = 0;
  for (int step = 0; step < steps; ++step)
  {
    const double share = static_cast<double>(1 + random() % 4) / 4;
    const auto what = random() % 9;
    what < 4     ? twins.append(share, what % 2 == 0)
      : what < 7 ? twins.remove(share / 2, what == 6)
                 : twins.renumber();
    if (step % 16 == 0)
    {
      twins.move();
    }
    ASSERT_NO_FATAL_FAILURE(twins.expectEqual()) << "seed " << seed << ", step " << step;
    most = std::max(most, twins.segments());
  }
  // Free slots are used again: memory is in proportion to the most that was stored.
  const std::size_t page = twins.arena().pageBytes();
  EXPECT_LE(twins.arena().bytesInUse(), (most + walks) * page / BouncePage::kSize + 2 * page)
    << "seed " << seed;
}

TEST(BounceBlock, AgreesWithAPlainModelUnderRandomOperations)
{
  compareWithModel(1, 1024, 1, 400 / kFewer);
  compareWithModel(2, 1024, 3, 200 / kFewer);
  compareWithModel(3, 1, 1, 400);
  compareWithModel(4, 700, 2, 200 / kFewer);
}

// Links of 16 bits reach 64 K slots, the count of bounces 255; walks may be longer.
TEST(BounceBlock, LongWalks)
{
  constexpr std::uint32_t kWalks = 16, kLength = 3 * 65536 / kWalks;
  Twins twins(5, kWalks, 1);
  for (std::uint32_t bounce = 0; bounce < kLength; ++bounce)
  {
    twins.append(1);
  }
  ASSERT_NO_FATAL_FAILURE(twins.expectEqual());
  for (int round = 0; round < 4; ++round)
  {
    twins.remove(0.5, round == 3);
    ASSERT_NO_FATAL_FAILURE(twins.expectEqual());
    for (std::uint32_t bounce = 0; bounce < kLength / 4; ++bounce)
    {
      twins.append(0.9);
    }
    ASSERT_NO_FATAL_FAILURE(twins.expectEqual());
  }
}

// A segment takes 32 bytes; pages are not quite full.
TEST(BounceBlock, FewBytesASegment)
{
  for (const double mean : { 2.0, 2.2, 2.5, 2.8, 3.0 })
  {
    Twins twins(6, 1024, 1);
    for (double alive = 1; alive > 1e-6; alive *= 1 - 1 / mean)
    {
      twins.append(alive);
    }
    const auto segments = static_cast<double>(twins.segments());
    EXPECT_LT(static_cast<double>(twins.block().bytes()) / segments, 36.0) << mean;
    EXPECT_LT(static_cast<double>(twins.arena().bytes()) / segments, 38.0 + 65536 / segments);
  }
}

TEST(BlockArena, UsesMemoryAgain)
{
  constexpr std::size_t kPage = sizeof(BouncePage);
  BlockArena arena(kPage);
  EXPECT_EQ(arena.bytes(), 0u);
  std::vector<void*> taken;
  for (int i = 0; i < 1000; ++i)
  {
    taken.push_back(arena.take());
    std::fill_n(static_cast<char*>(taken.back()), kPage, static_cast<char>(i));
  }
  EXPECT_EQ(arena.bytesInUse(), 1000 * kPage);
  EXPECT_GE(arena.bytes(), 1000 * kPage);
  EXPECT_LT(arena.bytes(), 2000 * kPage);
  for (int i = 0; i < 1000; ++i)
  {
    const char* const page = static_cast<const char*>(taken[static_cast<std::size_t>(i)]);
    ASSERT_EQ(std::count(page, page + kPage, static_cast<char>(i)), std::ptrdiff_t{ kPage });
  }
  const std::size_t held = arena.bytes();
  arena.release(); // nothing happens
  std::sort(taken.begin(), taken.end());
  for (int round = 0; round < 3; ++round)
  {
    for (void* const page : taken)
    {
      arena.giveBack(page);
    }
    std::vector<void*> again;
    for (std::size_t i = 0; i < taken.size(); ++i)
    {
      again.push_back(arena.take());
    }
    std::sort(again.begin(), again.end());
    ASSERT_EQ(again, taken);
  }
  EXPECT_EQ(arena.bytes(), held);
  for (void* const page : taken)
  {
    arena.giveBack(page);
  }
  EXPECT_EQ(arena.bytesInUse(), 0u);
  arena.release();
  EXPECT_LT(arena.bytes(), 1000u);
}

}
}
