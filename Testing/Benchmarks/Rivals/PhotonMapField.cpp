// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonMapField.h"

#include "../../PhotonWalks/HistoryPhotons.h"
#include "Walks/WalkSets.h"

using namespace irradiance;

namespace
{

std::array<float, 3> inFloats(const Vector3& vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
    static_cast<float>(vector[2]) };
}

/// Where the map is asked.
struct Middle
{
  Vector3 position = Vector3::Zero(); ///< times the area
  Vector3 normal = Vector3::Zero();   ///< area vector
  double area = 0;
};

std::vector<Middle> middlesOf(const SceneObject& object)
{
  std::vector<Middle> middles(object.material->numberOfCells);
  for (std::size_t i = 0; i < object.body->mesh().size(); ++i)
  {
    const Triangle triangle = transformed(object.worldFromObject, object.body->mesh()[i]);
    Middle& middle = middles[object.material->cellOfTriangle[i]];
    middle.position += triangle.area() * (triangle.a + triangle.b + triangle.c) / 3;
    middle.normal += triangle.areaVector();
    middle.area += triangle.area();
  }
  return middles;
}

}

std::vector<PhotonMap::Photon> mapPhotonsOf(const IrradianceEngine& engine)
{
  const StoredWalks walks(engine.walks(), engine.frame());
  const WalkHistory& history = test::onlySet(engine).history();
  std::vector<PhotonMap::Photon> photons;
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    std::vector<SegmentRef> segments;
    history.forEachPhoton(i, [&](const Photon& photon) { segments.push_back(photon.reference); });
    std::vector<Ray> rays(segments.size());
    walks.raysOf(segments, rays.data());
    for (std::size_t k = 0; k < segments.size(); ++k)
    {
      const Power power = history.power(segments[k]);
      const Vector3 place = engine.scene().surfaceOf(history.hit(segments[k]), true).position;
      photons.push_back({ inFloats(place), static_cast<float>(engine.watts(power[0])),
        PhotonMap::packed(inFloats(rays[k].direction)) });
    }
  }
  return photons;
}

CellField irradianceOf(const PhotonMap& map, const SceneObjects& objects, std::size_t count)
{
  std::vector<double> field;
  std::vector<PhotonMap::Neighbour> found;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (const Middle& middle : middlesOf(objects[object]))
    {
      field.push_back(map.irradiance(inFloats(middle.position / middle.area),
        inFloats(middle.normal.normalized()), count, found));
    }
  }
  return Eigen::Map<CellField>(field.data(), static_cast<Eigen::Index>(field.size()));
}
