// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkBlock.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace irradiance
{

namespace
{

using test::WalkSegment;

const UnitFrame kFrame;
const Hit kDynamicHit{ 1, { 1, 0 } };
const Power kPhoton{ { 1 << 20 } }; ///< of all segments, if there is one band

/// A WalkBlock in its plainest form.
struct Model
{
  std::vector<std::vector<WalkSegment>> walks;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Hit> staticHits;

  void replaceTail(std::uint32_t walk, std::uint32_t bounce, const std::vector<WalkSegment>& tail)
  {
    staticHits.erase(
      staticHits.upper_bound({ walk, bounce }), staticHits.lower_bound({ walk + 1, 0 }));
    walks[walk].resize(bounce);
    walks[walk].insert(walks[walk].end(), tail.begin(), tail.end());
  }
};

class RandomEntries
{
public:
  explicit RandomEntries(unsigned seed)
    : engine_(seed)
  {
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  Hit hit()
  {
    const auto weight = static_cast<float>(below(1000));
    return { 1.0 + below(1000), { below(5), below(100) }, { weight, 1 / (1 + weight) } };
  }
  std::vector<WalkSegment> tail(std::uint32_t size, int bands)
  {
    std::vector<WalkSegment> entries(size);
    for (WalkSegment& entry : entries)
    {
      entry.ray.origin = Vector3(below(99), below(99), below(99));
      entry.ray.direction = Vector3(below(99), below(99), below(99)).normalized();
      entry.hit = hit();
      entry.isFront = below(2) == 0;
      entry.power = kPhoton;
      for (int band = 0; band < bands && bands > 1; ++band)
      {
        entry.power[band] = below(1u << 30);
      }
    }
    return entries;
  }

private:
  std::mt19937 engine_;
};

/// Checks both ends of all segments, each found through its point.
void expectPoints(const WalkBlock& block, const std::vector<std::vector<WalkSegment>>& walks)
{
  std::size_t found = 0, stored = 0;
  for (const auto& walk : walks)
  {
    stored += walk.size();
  }
  for (std::size_t i = 0; i + 1 < block.numberOfPoints(); ++i)
  {
    const auto place = block.segmentAt(i);
    if (!place)
    {
      continue;
    }
    ++found;
    const std::vector<WalkSegment>& walk = walks[place->walk - block.firstWalk()];
    const WalkSegment& segment = walk[place->bounce];
    const Vector3 end = segment.ray.origin + segment.hit.distance * segment.ray.direction;
    const bool isLast = place->bounce + 1 == walk.size();
    const Vector3 next = isLast ? end : walk[place->bounce + 1].ray.origin;
    ASSERT_EQ(block.x()[i], static_cast<float>(segment.ray.origin[0]));
    ASSERT_EQ(block.z()[i], static_cast<float>(segment.ray.origin[2]));
    ASSERT_EQ(block.y()[i + 1], static_cast<float>(next[1]));
    ASSERT_EQ(block.tags()[i] >> WalkBlock::kTagShift, WalkBlock::tagOf(segment.hit.id.object));
  }
  ASSERT_EQ(found, stored);
}

void expectEqual(const WalkBlock& block, const Model& model)
{
  expectPoints(block, model.walks);
  for (std::uint32_t walk = 0; walk < block.numberOfWalks(); ++walk)
  {
    const std::uint32_t number = block.firstWalk() + walk;
    ASSERT_EQ(block.size(number), model.walks[walk].size()) << "walk " << walk;
    for (std::uint32_t i = 0; i < block.size(number); ++i)
    {
      const WalkSegment& entry = model.walks[walk][i];
      const SegmentRef segment{ number, i };
      ASSERT_EQ(block.hit(segment).id, entry.hit.id);
      ASSERT_EQ(block.hit(segment).weights, entry.hit.weights);
      ASSERT_EQ(block.power(segment), entry.power);
      ASSERT_EQ(block.isFront(segment), entry.isFront);
      const auto found = model.staticHits.find({ walk, i });
      const Hit* hit = block.hiddenStaticHit(segment);
      ASSERT_EQ(hit != nullptr, found != model.staticHits.end()) << walk << ", " << i;
      ASSERT_TRUE(!hit || *hit == found->second);
    }
  }
}

/// 20,000 random operations on 50 walks. A tail is never empty: a walk ends with a hit or an
/// escape.
void compareWithModel(unsigned seed, int bands)
{
  RandomEntries random(seed);
  constexpr std::uint32_t kFirst = 70 * 1024; // not the first block
  WalkBlock block(kFirst, 50, bands, kFrame, kPhoton);
  Model model{ std::vector<std::vector<WalkSegment>>(50), {} };
  std::size_t mostSegments = 0;
  for (int step = 0; step < 20000; ++step)
  {
    const std::uint32_t walk = random.below(50);
    const auto size = static_cast<std::uint32_t>(model.walks[walk].size());
    const std::uint32_t bounce = random.below(size + 1), what = random.below(10);
    if (what < 5 || size == 0)
    {
      const auto tail = random.tail(1 + random.below(random.below(10) == 0 ? 60 : 6), bands);
      test::replaceTail(block, { kFirst + walk, bounce }, tail, kFrame, bands);
      model.replaceTail(walk, bounce, tail);
    }
    else if (bounce < size && what < 8)
    {
      Hit hit = random.hit();
      hit.id.object = 0;
      block.updateStaticHit({ kFirst + walk, bounce }, hit, kDynamicHit, true);
      model.staticHits[{ walk, bounce }] = hit;
    }
    else if (what < 9)
    {
      block.updateStaticHit({ kFirst + walk, bounce }, kDynamicHit, {}, true);
      model.staticHits.erase({ walk, bounce });
    }
    else if (random.below(100) == 0)
    {
      block.forgetAllStaticHits();
      model.staticHits.clear();
    }
    if (step % 50 == 0)
    {
      ASSERT_NO_FATAL_FAILURE(expectEqual(block, model)) << "step " << step;
    }
    std::size_t segments = 0;
    for (const auto& entries : model.walks)
    {
      segments += entries.size();
    }
    mostSegments = std::max(mostSegments, segments);
  }
  ASSERT_NO_FATAL_FAILURE(expectEqual(block, model));
  // Holes are closed: the pools stay in proportion to the most they held, static hits included.
  EXPECT_LT(block.bytes(), 6 * mostSegments * (sizeof(WalkSegment) + 32) + 10000);
  std::printf(
    "seed %u: at most %zu segments, in the end %zu bytes\n", seed, mostSegments, block.bytes());
}

}

TEST(WalkBlock, AgreesWithAPlainModelUnderRandomOperations)
{
  compareWithModel(1, 1);
  compareWithModel(2, 3);
}

TEST(WalkBlock, TailsGrowAndShrink)
{
  RandomEntries random(5);
  WalkBlock block(0, 3, 3, kFrame, kPhoton);
  Model model{ std::vector<std::vector<WalkSegment>>(3), {} };
  for (const std::uint32_t size : { 1u, 5u, 2u, 9u, 9u, 1u })
  {
    for (std::uint32_t walk = 0; walk < 3; ++walk)
    {
      const auto bounce = std::min<std::uint32_t>(walk, block.size(walk));
      const auto tail = random.tail(size, 3);
      test::replaceTail(block, { walk, bounce }, tail, kFrame, 3);
      model.replaceTail(walk, bounce, tail);
      ASSERT_NO_FATAL_FAILURE(expectEqual(block, model));
    }
  }
}

TEST(WalkBlock, StaticHitsBehindTheNewTailAreForgotten)
{
  RandomEntries random(6);
  WalkBlock block(0, 2, 1, kFrame, kPhoton);
  for (std::uint32_t walk = 0; walk < 2; ++walk)
  {
    test::replaceTail(block, { walk, 0 }, random.tail(5, 1), kFrame);
    for (std::uint32_t i = 0; i < 5; ++i)
    {
      block.updateStaticHit({ walk, i }, { 10.0 + i, { 0, i } }, kDynamicHit, true);
    }
  }
  test::replaceTail(block, { 0, 2 }, random.tail(4, 1), kFrame);
  for (std::uint32_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(block.hiddenStaticHit({ 0, i }) != nullptr, i <= 2) << i;
    EXPECT_NE(block.hiddenStaticHit({ 1, i }), nullptr);
  }
  // A static miss is remembered too.
  block.updateStaticHit({ 1, 0 }, {}, kDynamicHit, true);
  ASSERT_NE(block.hiddenStaticHit({ 1, 0 }), nullptr);
  EXPECT_FALSE(*block.hiddenStaticHit({ 1, 0 }));
}

TEST(WalkBlock, HolesAreClosed)
{
  RandomEntries random(7);
  WalkBlock block(0, 100, 1, kFrame, kPhoton);
  for (int round = 0; round < 200; ++round)
  {
    for (std::uint32_t walk = 0; walk < 100; ++walk)
    {
      test::replaceTail(block, { walk, 0 }, random.tail(1, 1), kFrame);
      test::replaceTail(block, { walk, 0 }, random.tail(1 + (walk + round) % 20, 1), kFrame);
    }
  }
  // At most 20 segments per walk, a third of holes, and the spare capacity of vectors.
  EXPECT_LT(block.bytes(), 100 * 20 * (sizeof(WalkSegment) + 8) * 3 + 10000);
}

}
