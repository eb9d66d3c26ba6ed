#include "WalkHistory.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace irradiance
{

namespace
{

struct Entry
{
  WalkSegment segment;
  Power power;
  bool isFront;
};

/// The same as a WalkBlock in the plainest way.
struct Model
{
  std::vector<std::vector<Entry>> walks;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Hit> staticHits;

  void replaceTail(std::uint32_t walk, std::uint32_t bounce, const std::vector<Entry>& tail)
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
  Hit hit() { return { 1.0 + below(1000), { below(5), below(100) } }; }
  std::vector<Entry> tail(std::uint32_t size, int bands)
  {
    std::vector<Entry> entries(size);
    for (Entry& entry : entries)
    {
      entry.segment.origin = Vector3(below(99), below(99), below(99));
      entry.segment.direction = Vector3(below(99), below(99), below(99));
      entry.segment.hit = hit();
      entry.isFront = below(2) == 0;
      for (int band = 0; band < bands; ++band)
      {
        entry.power[band] = below(1u << 30);
      }
    }
    return entries;
  }

private:
  std::mt19937 engine_;
};

WalkTrace traceOf(const std::vector<Entry>& entries)
{
  WalkTrace trace;
  for (const Entry& entry : entries)
  {
    trace.add(entry.segment, entry.power, entry.isFront);
  }
  return trace;
}

void expectEqual(const WalkBlock& block, const Model& model, bool withSides)
{
  for (std::uint32_t walk = 0; walk < block.numberOfWalks(); ++walk)
  {
    ASSERT_EQ(block.size(walk), model.walks[walk].size()) << "walk " << walk;
    for (std::uint32_t i = 0; i < block.size(walk); ++i)
    {
      const Entry& entry = model.walks[walk][i];
      ASSERT_EQ(block.segment(walk, i).origin, entry.segment.origin);
      ASSERT_EQ(block.segment(walk, i).direction, entry.segment.direction);
      ASSERT_EQ(block.segment(walk, i).hit, entry.segment.hit);
      ASSERT_EQ(block.power(walk, i), entry.power);
      ASSERT_EQ(block.isFront(walk, i), !withSides || entry.isFront);
      const auto found = model.staticHits.find({ walk, i });
      const Hit* hit = block.hiddenStaticHit(walk, i);
      ASSERT_EQ(hit != nullptr, found != model.staticHits.end()) << walk << ", " << i;
      ASSERT_TRUE(!hit || *hit == found->second);
    }
  }
}

/// 20,000 random operations on 50 walks. A tail is never empty: a walk ends with a hit or an
/// escape.
void compareWithModel(unsigned seed, int bands, bool withSides)
{
  RandomEntries random(seed);
  WalkBlock block(50, bands, withSides);
  Model model{ std::vector<std::vector<Entry>>(50), {} };
  std::size_t mostSegments = 0;
  for (int step = 0; step < 20000; ++step)
  {
    const std::uint32_t walk = random.below(50);
    const auto size = static_cast<std::uint32_t>(model.walks[walk].size());
    const std::uint32_t bounce = random.below(size + 1), what = random.below(10);
    if (what < 5 || size == 0)
    {
      const auto tail = random.tail(1 + random.below(random.below(10) == 0 ? 60 : 6), bands);
      block.replaceTail(walk, bounce, traceOf(tail));
      model.replaceTail(walk, bounce, tail);
    }
    else if (bounce < size && what < 8)
    {
      const Hit hit = random.hit();
      block.rememberStaticHit(walk, bounce, hit);
      model.staticHits[{ walk, bounce }] = hit;
    }
    else if (what < 9)
    {
      block.forgetStaticHit(walk, bounce);
      model.staticHits.erase({ walk, bounce });
    }
    else if (random.below(100) == 0)
    {
      block.forgetAllStaticHits();
      model.staticHits.clear();
      block.shrink();
    }
    if (step % 50 == 0)
    {
      ASSERT_NO_FATAL_FAILURE(expectEqual(block, model, withSides)) << "step " << step;
    }
    std::size_t segments = 0;
    for (const auto& entries : model.walks)
    {
      segments += entries.size();
    }
    mostSegments = std::max(mostSegments, segments);
  }
  ASSERT_NO_FATAL_FAILURE(expectEqual(block, model, withSides));
  // Holes are closed: the pools stay in proportion to what was held at most, static hits included.
  EXPECT_LT(block.bytes(), 6 * mostSegments * (sizeof(WalkSegment) + 32) + 10000);
  std::printf(
    "seed %u: at most %zu segments, in the end %zu bytes\n", seed, mostSegments, block.bytes());
}

}

TEST(WalkHistory, AgreesWithAPlainModelUnderRandomOperations)
{
  compareWithModel(1, 1, false);
  compareWithModel(2, 1, true);
  compareWithModel(3, 3, false);
  compareWithModel(4, 3, true);
}

TEST(WalkHistory, TailsGrowAndShrink)
{
  RandomEntries random(5);
  WalkBlock block(3, 3, true);
  Model model{ std::vector<std::vector<Entry>>(3), {} };
  for (const std::uint32_t size : { 1u, 5u, 2u, 0u, 9u, 9u, 1u })
  {
    for (std::uint32_t walk = 0; walk < 3; ++walk)
    {
      const auto bounce = std::min<std::uint32_t>(walk, block.size(walk));
      const auto tail = random.tail(size, 3);
      block.replaceTail(walk, bounce, traceOf(tail));
      model.replaceTail(walk, bounce, tail);
      ASSERT_NO_FATAL_FAILURE(expectEqual(block, model, true));
    }
  }
}

TEST(WalkHistory, StaticHitsBehindTheNewTailAreForgotten)
{
  RandomEntries random(6);
  WalkBlock block(2, 1, false);
  for (std::uint32_t walk = 0; walk < 2; ++walk)
  {
    block.replaceTail(walk, 0, traceOf(random.tail(5, 1)));
    for (std::uint32_t i = 0; i < 5; ++i)
    {
      block.rememberStaticHit(walk, i, { 10.0 + i, { 0, i } });
    }
  }
  block.replaceTail(0, 2, traceOf(random.tail(4, 1)));
  for (std::uint32_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(block.hiddenStaticHit(0, i) != nullptr, i <= 2) << i;
    EXPECT_NE(block.hiddenStaticHit(1, i), nullptr);
  }
  // A static "nowhere" is worth remembering, too.
  block.rememberStaticHit(1, 0, {});
  ASSERT_NE(block.hiddenStaticHit(1, 0), nullptr);
  EXPECT_FALSE(*block.hiddenStaticHit(1, 0));
}

TEST(WalkHistory, HolesAreClosed)
{
  RandomEntries random(7);
  WalkBlock block(100, 1, false);
  for (int round = 0; round < 200; ++round)
  {
    for (std::uint32_t walk = 0; walk < 100; ++walk)
    {
      block.replaceTail(walk, 0, traceOf(random.tail(1, 1)));
      block.replaceTail(walk, 0, traceOf(random.tail(1 + (walk + round) % 20, 1)));
    }
  }
  // 20 segments a walk at most, a third of holes, and what a vector keeps in reserve.
  EXPECT_LT(block.bytes(), 100 * 20 * (sizeof(WalkSegment) + 8) * 3 + 10000);
}

}
