// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Rivals/CellPhotonSets.h"
#include "Rivals/PhotonSet.h"

namespace irradiance::test
{
namespace
{

/// A moving scene in which every third cell is specular, each in one band alone. The third object
/// has no specular cell.
class PartlyGlossyScene : public MovingScene
{
public:
  explicit PartlyGlossyScene(unsigned seed)
    : MovingScene(3, false, seed, true)
  {
    for (std::uint32_t object = 0; object <= kObjects; ++object)
    {
      materials_.push_back(partlyGlossy(*MovingScene::objects()[object].material, object != 2));
    }
  }

  SceneObjects objects() const
  {
    SceneObjects objects = MovingScene::objects();
    objects.staticObject.material = materials_[0];
    for (std::size_t i = 0; i < objects.dynamicObjects.size(); ++i)
    {
      objects.dynamicObjects[i].material = materials_[i + 1];
    }
    return objects;
  }

private:
  static std::shared_ptr<const Material> partlyGlossy(Material material, bool hasGloss)
  {
    std::vector<double> specular = material.specularReflectance;
    for (std::size_t i = 0; i < specular.size(); ++i)
    {
      const std::size_t cell = i / 3, band = i % 3;
      specular[i] = cell % 3 == 0 && band == cell / 3 % 3 ? specular[i] : 0.0;
    }
    if (hasGloss)
    {
      material.setSpecular(specular, material.phongExponent);
    }
    else
    {
      material.specularReflectance.clear();
      material.phongExponent.clear();
    }
    return std::make_shared<const Material>(std::move(material));
  }

  std::vector<std::shared_ptr<const Material>> materials_;
};

CellPhotonSets filledFrom(const IrradianceEngine& engine)
{
  CellPhotonSets sets(engine.objects());
  ThreadExecution threads(3);
  sets.add(onlySet(engine).history(), 0, onlySet(engine).history().size(), threads);
  return sets;
}

/// The photons on each cell, looked for one by one.
using Lists = std::map<std::pair<std::uint32_t, std::size_t>, std::vector<SegmentRef>>;

Lists listsOf(const std::vector<Photon>& photons, const SceneObjects& objects)
{
  Lists lists;
  for (const Photon& photon : photons)
  {
    const Material& material = *objects[photon.id.object].material;
    lists[{ photon.id.object, material.cellOfTriangle[photon.id.triangle] }].push_back(
      photon.reference);
  }
  return lists;
}

void expectEqual(const CellPhotonSets& sets, const Lists& lists, const SceneObjects& objects)
{
  std::size_t photons = 0;
  CellNumbers(objects).forEach([&](const SceneCell& cell) {
    const auto found = lists.find({ cell.object, cell.cell });
    const bool hasPhotons =
      found != lists.end() && objects[cell.object].material->isSpecular(cell.cell);
    const std::vector<SegmentRef> expected = hasPhotons ? found->second : std::vector<SegmentRef>();
    ASSERT_EQ(sets.sorted(cell), expected) << cell.object << ", " << cell.cell;
    ASSERT_EQ(sets.size(cell), expected.size());
    photons += expected.size();
  });
  ASSERT_GT(photons, 0u);
}

TEST(CellPhotonSets, AfterUpdatesTheyAreThoseOfTheHistory)
{
  PartlyGlossyScene scene(71);
  const Shoot settings(5000);
  ThreadExecution threads(3);
  UpdatedEngine engine(scene.objects(), settings);
  CellPhotonSets updated = filledFrom(engine);
  std::vector<Photon> photons = photonsOf(onlySet(engine).history());
  std::size_t changed = 0;
  for (int frame = 0; frame < 12; ++frame)
  {
    scene.nextFrame();
    const SceneObjects objects = scene.objects();
    engine.update(objects, settings);
    const std::vector<Photon> now = photonsOf(onlySet(engine).history());
    const PhotonChanges changes = changesBetween(photons, now);
    changed += changes.gone.size() + changes.arrived.size();
    updated.apply(changes, threads);
    photons = now;
    const Lists lists = listsOf(photons, objects);
    ASSERT_NO_FATAL_FAILURE(expectEqual(updated, lists, objects)) << "frame " << frame;
    ASSERT_NO_FATAL_FAILURE(expectEqual(filledFrom(engine), lists, objects)) << "frame " << frame;
  }
  EXPECT_GT(changed, photons.size());
}

TEST(CellPhotonSets, OnlySpecularCellsArePaidFor)
{
  const MovingScene matte(1, true, 73);
  UpdatedEngine engine(matte.objects(), Shoot(5000));
  const CellPhotonSets nothing = filledFrom(engine);
  EXPECT_TRUE(nothing.isEmpty());
  // Even of the objects, nothing but that they have none.
  EXPECT_LE(nothing.bytes(), sizeof(nothing) + 64 * matte.objects().size());

  const SceneObjects objects = PartlyGlossyScene(73).objects();
  engine.update(objects, Shoot(40000));
  const CellPhotonSets sets = filledFrom(engine);
  std::size_t cells = 0, specular = 0, photons = 0;
  CellNumbers(objects).forEach([&](const SceneCell& cell) {
    ++cells;
    specular += objects[cell.object].material->isSpecular(cell.cell) ? 1 : 0;
    photons += sets.size(cell);
  });
  EXPECT_LE(sets.bytes(), 16 * photons + 64 * specular + 4 * cells + 1000);
}

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
