// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "LightGroups.h"
#include "Views/StoredSensors.h"

#include <map>
#include <string>
#include <vector>

namespace irradiance
{

/// What sensors gather of all light groups, see StoredSensors. Groups are independent, so their
/// replicates add up.
class GroupSensors
{
public:
  using Replicates = SensorFinalGather::Replicates;

  /// See StoredSensors.
  void update(const LightGroups& groups, const std::vector<Sensor>& sensors, std::uint32_t rays,
    bool keepsRays, Execution& execution)
  {
    std::map<std::string, StoredSensors> before = std::move(stored_);
    stored_.clear();
    replicates_.assign(
      sensors.size(), Replicates(groups.any().walks().plan().replicates().count()));
    const auto all = static_cast<double>(groups.numberOfLit());
    groups.forEachLit([&](const LightGroup& group) {
      const auto done = static_cast<double>(stored_.size());
      ProgressSpan part(execution, done / all, (done + 1) / all);
      stored_.insert(before.extract(group.name));
      StoredSensors& stored = stored_[group.name];
      stored.update(group.engine, sensors, rays, keepsRays, part);
      for (std::size_t i = 0; i < sensors.size(); ++i)
      {
        add(stored.replicates()[i], group, replicates_[i]);
      }
    });
  }
  /// Of all sensors.
  const std::vector<Replicates>& replicates() const { return replicates_; }
  /// What one group brings to a sensor.
  Replicates ofGroup(const LightGroup& group, std::size_t sensor) const
  {
    Replicates sum(replicates_[sensor].size());
    if (group.engine)
    {
      add(stored_.at(group.name).replicates()[sensor], group, sum);
    }
    return sum;
  }

private:
  static void add(const Replicates& found, const LightGroup& group, Replicates& sum)
  {
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      for (std::size_t band = 0; band < sum[k].size(); ++band)
      {
        sum[k][band] += group.shown(found[k][band], static_cast<int>(band));
      }
    }
  }

  std::map<std::string, StoredSensors> stored_;
  std::vector<Replicates> replicates_;
};

}
