// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestScenes.h"
#include "../RayCasting/TestSimdLevels.h"
#include "BounceFront.h"
#include "History/SegmentIndex.h"

#include <gtest/gtest.h>

#include <algorithm>

// Law: an index finds what a scan of all segments finds, over many frames of removals and appends.

namespace irradiance
{

namespace
{

using test::BounceFront;
using test::BounceSegment;

constexpr std::uint32_t kWalks = 300;

/// Some blocks of random walks, their index, and a frame's changes.
class Indexed
{
public:
  Indexed(unsigned seed, std::size_t blocks)
    : random_(seed)
    , arena_(BounceBlock::pageBytes(1))
  {
    Box box;
    box.add(Vector3(-2, -3, -1));
    box.add(Vector3(2, 3, 1));
    grid_ = PointGrid(box);
    for (std::size_t i = 0; i < blocks; ++i)
    {
      blocks_.emplace_back(arena_, 0, kWalks, 1, grid_, Power{});
    }
    for (std::size_t i = 0; i < blocks; ++i)
    {
      append(i, 1, nullptr);
      append(i, 0.6, nullptr);
      append(i, 0.4, nullptr);
    }
    index_ = SegmentIndex(all());
  }

  SegmentIndex::Blocks all() const
  {
    SegmentIndex::Blocks all;
    for (const BounceBlock& block : blocks_)
    {
      all.push_back(&block);
    }
    return all;
  }

  /// Removes some tails and appends others, which the index is told of.
  void change()
  {
    for (std::size_t i = 0; i < blocks_.size(); ++i)
    {
      for (std::uint32_t walk = 0; walk < kWalks; ++walk)
      {
        const auto bounce = static_cast<std::uint32_t>(random_.uniform(0, 3));
        const std::uint32_t slot = blocks_[i].slotOf({ walk, bounce });
        if (random_.uniform(0, 1) < 0.1 && slot != BounceBlock::kNone)
        {
          blocks_[i].removeFrom(slot);
        }
      }
      append(i, 0.05, &index_);
      append(i, 0.05, &index_);
    }
    isRebuilt_ = index_.isWorn();
    if (isRebuilt_)
    {
      index_ = SegmentIndex(all());
    }
  }
  bool isRebuilt() const { return isRebuilt_; }

  BounceScan scan(std::size_t bodies, double size)
  {
    const auto ball = test::bodyOf(test::icosphere(1));
    BounceScan scan(grid_);
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const AffineMap pose{ size * random_.powerOfTwo(-2, 0) * random_.rotation(),
        Vector3(2, 3, 1).cwiseProduct(random_.inCube()) };
      const OwnBox own{ ball->mesh().bounds(), pose, 0 };
      scan.addBody(EllipsoidBound(ball->ellipsoid(), ball->mesh().bounds(), pose, 0),
        i % 2 == 0 ? &own : nullptr);
      scan.addMoved(static_cast<std::uint32_t>(random_.uniform(1, 20)));
    }
    return scan;
  }

  /// Whether both find the same, on each instruction set; returns how much.
  std::size_t compare(const BounceScan& scan) const
  {
    std::size_t count = 0;
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      std::vector<std::vector<std::uint32_t>> found;
      index_.find(all(), scan, found);
      for (std::size_t i = 0; i < blocks_.size(); ++i)
      {
        std::vector<std::uint32_t> flat;
        scan.find(blocks_[i], blocks_[i], flat);
        EXPECT_EQ(found[i], flat) << "block " << i << ", SIMD level " << static_cast<int>(level);
        count += flat.size();
      }
    }
    return count / test::simdLevels().size();
  }

  const SegmentIndex& index() const { return index_; }
  std::size_t segments() const
  {
    std::size_t segments = 0;
    for (const BounceBlock& block : blocks_)
    {
      block.forEach([&](std::uint32_t) { ++segments; });
    }
    return segments;
  }

private:
  Vector3 place() { return Vector3(2, 3, 1).cwiseProduct(random_.inCube()); }

  /// One more segment for a share of the walks of a block; some escape.
  void append(std::size_t block, double share, SegmentIndex* index)
  {
    BounceFront front;
    for (std::uint32_t walk = 0; walk < kWalks; ++walk)
    {
      const std::uint32_t last = blocks_[block].lastOf(walk);
      if (random_.uniform(0, 1) < share)
      {
        const Vector3 from = place(), to = place();
        BounceSegment segment;
        segment.origin = from;
        segment.direction = (to - from).normalized().cast<float>();
        segment.distance = random_.uniform() > 0.8 ? kInfinity : (to - from).norm();
        segment.walk = walk;
        segment.parent = last;
        segment.kind = BounceTag::kindOf(static_cast<std::uint32_t>(random_.uniform(0, 200)));
        front.add(segment);
      }
    }
    const std::vector<std::uint32_t> slots = front.appendTo(blocks_[block]);
    if (index != nullptr)
    {
      index->add(all(), block, slots.data(), slots.size());
    }
  }

  test::RandomVectors random_;
  BlockArena arena_;
  PointGrid grid_;
  std::vector<BounceBlock> blocks_;
  SegmentIndex index_;
  bool isRebuilt_ = false;
};

}

TEST(SegmentIndex, FindsWhatAScanOfAllFinds)
{
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    Indexed indexed(seed, 1 + 5 * seed);
    std::size_t found = 0, rebuilt = 0;
    for (int frame = 0; frame < 30; ++frame)
    {
      const std::size_t bodies = frame % 3 == 0 ? 1 : frame % 3 == 1 ? 12 : 100;
      const BounceScan scan = indexed.scan(bodies, bodies == 1 ? 1.0 : 0.1);
      found += indexed.compare(scan);
      ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << ", frame " << frame;
      indexed.change();
      rebuilt += indexed.isRebuilt() ? 1 : 0;
    }
    EXPECT_GT(found, 1000u);
    EXPECT_GT(rebuilt, 0u);
  }
}

// Of a body that is not known, and of one that is not within the grid.
TEST(SegmentIndex, FindsAllWhereFloatsTellTooLittle)
{
  Indexed indexed(5, 3);
  const auto ball = test::bodyOf(test::icosphere(1));
  for (const double size : { std::numeric_limits<double>::quiet_NaN(), 3.0 })
  {
    BounceScan scan = indexed.scan(9, 0.1);
    const AffineMap pose{ size * Matrix3::Identity(), { 0, 0, 0 } };
    scan.addBody(EllipsoidBound(ball->ellipsoid(), ball->mesh().bounds(), pose, 0));
    EXPECT_GT(indexed.compare(scan), indexed.segments() / 2);
  }
}

TEST(SegmentIndex, FewBytesASegment)
{
  const Indexed indexed(4, SegmentIndex::kBlocks);
  EXPECT_LT(static_cast<double>(indexed.index().bytes()),
    18.5 * static_cast<double>(indexed.segments()) + 18 * 4096);
}

// Blocks without segments have an index as well.
TEST(SegmentIndex, OfNothing)
{
  BlockArena arena(BounceBlock::pageBytes(1));
  const BounceBlock block(arena, 0, 5, 1, PointGrid(), Power{});
  const SegmentIndex index({ &block });
  std::vector<std::vector<std::uint32_t>> found;
  index.find({ &block }, BounceScan(block.grid()), found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].empty());
}

}
