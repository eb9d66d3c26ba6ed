// SPDX-License-Identifier: BSD-3-Clause
#include "Views/SensorDirectLight.h"

namespace irradiance
{

SensorDirectLight::SensorDirectLight(const IrradianceEngine& engine)
  : scene_(engine.scene())
{
  for (const WalkSet& set : engine.walks().sets())
  {
    // The sets of dynamic cells have the same lights.
    if (set.source().cells && !set.source().isDynamic() && !set.lights().isEmpty())
    {
      groups_.emplace_back(
        engine.frame(), set.source().knownLamps(), engine.settings().seed + groups_.size());
    }
  }
}

Bands SensorDirectLight::irradiance(const Foot& foot, std::uint64_t number) const
{
  const LitPoint point = LitPoint::onTriangle(
    scene_.worldTriangle(foot.id), foot.id, foot.isFront, foot.sensor.position);
  Bands sum{};
  for (const PointDirectLight& lights : groups_)
  {
    sum += lights.irradiance(point, number);
  }
  return sum;
}

}
