// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Rivals/CellPhotonSets.h"

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

}
}
