// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

// A leaf holds what a plain set would hold, however it is cut.

namespace irradiance::test
{
namespace
{

bool operator==(const LeafPhoton& a, const LeafPhoton& b)
{
  return std::tie(a.position, a.walk, a.bounceAndSide, a.triangle) ==
    std::tie(b.position, b.walk, b.bounceAndSide, b.triangle);
}

using Model = std::map<SegmentRef, LeafPhoton>;

/// How photons lie.
enum class Lie
{
  OnAPlane,
  InSpace,
  InFewPlaces,
  InOnePlace,
  InALine,      ///< they arrive in order
  TowardsAPoint ///< each nearer to it than all before: one plane below the other
};

class RandomPhotons
{
public:
  RandomPhotons(Lie lie, unsigned seed)
    : lie_(lie)
    , random_(seed)
  {
  }

  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(random_() % n); }
  float coordinate() { return std::uniform_real_distribution<float>(-1, 1)(random_); }
  LeafPhoton next()
  {
    ++count_;
    return { place(), { count_ / 3, count_ % 3 }, random_() % 2 == 0, below(100) };
  }

private:
  UnitPoint place()
  {
    switch (lie_)
    {
      case Lie::OnAPlane:
        return { coordinate(), coordinate(), 0.25F };
      case Lie::InSpace:
        return { coordinate(), coordinate(), coordinate() };
      case Lie::InFewPlaces:
        return { 0.5F * static_cast<float>(below(3)), 0.25F * static_cast<float>(below(2)), -1 };
      case Lie::InOnePlace:
        return { 0.5F, -0.5F, 1 };
      case Lie::InALine:
        return { 1e-5F * static_cast<float>(count_), 0, 0 };
      default:
        return { std::pow(0.99F, static_cast<float>(count_)), 0, 0 };
    }
  }

  Lie lie_;
  std::mt19937 random_;
  std::uint32_t count_ = 0;
};

void expectEqual(const PhotonTree& leaf, const Model& model)
{
  ASSERT_EQ(leaf.size(), model.size());
  const std::vector<LeafPhoton> photons = leaf.photons();
  ASSERT_EQ(photons.size(), model.size());
  for (const LeafPhoton& photon : photons)
  {
    const auto known = model.find(photon.reference());
    ASSERT_TRUE(known != model.end() && known->second == photon);
  }
}

float squaredDistance(const UnitPoint& a, const UnitPoint& b)
{
  float squared = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    squared += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return squared;
}

/// All photons within a distance are visited, each once, and not much else.
void expectFound(const PhotonTree& leaf, const Model& model, const UnitPoint& point, float squared)
{
  Model near;
  std::size_t visited = 0;
  leaf.visitNear(
    point, [&] { return squared; },
    [&](const PhotonPack& pack) {
      for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
      {
        ASSERT_TRUE(!pack.isUsed(lane) || near.emplace(pack.reference(lane), pack[lane]).second);
        visited += pack.isUsed(lane) ? 1 : 0;
      }
    });
  for (const auto& [reference, photon] : model)
  {
    ASSERT_TRUE(squaredDistance(photon.position, point) > squared || near.count(reference) == 1);
  }
}

Model::iterator anyOf(Model& model, RandomPhotons& random)
{
  const auto found = model.lower_bound({ random.below(model.rbegin()->first.walk + 1), 0 });
  return found == model.end() ? model.begin() : found;
}

void compareWithModel(Lie lie, unsigned seed)
{
  RandomPhotons random(lie, seed);
  PhotonTree leaf;
  Model model;
  for (int step = 0; step < 400; ++step)
  {
    // It grows to some thousands, and shrinks again.
    const bool grows = step < 200;
    const auto count = [&](bool isMore) {
      return random.below(random.below(10) == 0 ? 500 : isMore ? 60 : 30);
    };
    std::vector<LeafPhoton> gone, arrived;
    for (std::uint32_t i = count(!grows); i > 0 && !model.empty(); --i)
    {
      const auto chosen = anyOf(model, random);
      gone.push_back(chosen->second);
      gone.back().bounceAndSide ^= 1; // the side need not be known
      model.erase(chosen);
    }
    for (std::uint32_t i = count(grows); i > 0; --i)
    {
      arrived.push_back(random.next());
      model.emplace(arrived.back().reference(), arrived.back());
    }
    ASSERT_TRUE(leaf.change(gone, arrived));
    ASSERT_NO_FATAL_FAILURE(expectEqual(leaf, model)) << "step " << step;
    ASSERT_NO_FATAL_FAILURE(expectFound(leaf, model,
      { random.coordinate(), random.coordinate(), random.coordinate() }, random.coordinate()))
      << "step " << step;
  }
}

TEST(PhotonTree, AgreesWithAPlainModelUnderRandomOperations)
{
  for (const Lie lie : { Lie::OnAPlane, Lie::InSpace, Lie::InFewPlaces, Lie::InOnePlace,
         Lie::InALine, Lie::TowardsAPoint })
  {
    ASSERT_NO_FATAL_FAILURE(compareWithModel(lie, 1)) << static_cast<int>(lie);
    ASSERT_NO_FATAL_FAILURE(compareWithModel(lie, 2)) << static_cast<int>(lie);
  }
}

// A search near a point looks at few of many photons, whether they came together or one by one.
TEST(PhotonTree, LooksAtFew)
{
  constexpr std::uint32_t kPhotons = 20000;
  RandomPhotons random(Lie::OnAPlane, 3);
  PhotonTree together, single;
  std::vector<LeafPhoton> all;
  for (std::uint32_t i = 0; i < kPhotons; ++i)
  {
    all.push_back(random.next());
    ASSERT_TRUE(single.change({}, { { all.back() } }));
  }
  ASSERT_TRUE(together.change({}, all));
  for (const PhotonTree* leaf : { &together, &single })
  {
    std::size_t packs = 0;
    const float radius = 0.02F; // of 2 x 2: with 6 photons
    for (int i = 0; i < 100; ++i)
    {
      leaf->visitNear(
        { random.coordinate(), random.coordinate(), 0.25F }, [&] { return radius * radius; },
        [&](const PhotonPack&) { ++packs; });
    }
    EXPECT_LT(packs, 100u * 8u);
    EXPECT_GE(packs, 100u);
    EXPECT_LT(leaf->bytes(), std::size_t{ kPhotons } * 70);
  }
}

TEST(PhotonTree, GivesBackItsMemory)
{
  RandomPhotons random(Lie::InSpace, 4);
  PhotonTree leaf;
  std::vector<LeafPhoton> all(5000);
  std::generate(all.begin(), all.end(), [&] { return random.next(); });
  ASSERT_TRUE(leaf.change({}, all));
  while (all.size() > 10)
  {
    ASSERT_TRUE(leaf.change({ { all.back() } }, {}));
    all.pop_back();
  }
  EXPECT_LT(leaf.bytes(), 4000u);
  for (const LeafPhoton& photon : all)
  {
    ASSERT_TRUE(leaf.change({ { photon } }, {}));
  }
  EXPECT_EQ(leaf.bytes(), 0u);
  EXPECT_FALSE(leaf.change({ { random.next() } }, {}));
}

}
}
