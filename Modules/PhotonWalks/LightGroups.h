// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/AutomaticChoice.h"
#include "IrradianceEngine.h"
#include "Surfaces/GroupLamps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace irradiance
{

/// What a scene says of a group of its lamps.
struct LampGroup
{
  std::string name;
  bool isNamed = false;                ///< else it is a group as nobody gave its lamps one
  Bands factor{ { 1, 1, 1 } };         ///< of what they emit, by band: finite, >= 0
  std::optional<std::uint64_t> seed{}; ///< none: of all groups
};

/// The light of the lamps of a group.
struct LightGroup
{
  std::string name;
  Bands factor{}, scale{};
  std::uint32_t number = Emission::kNone;   ///< see Emission::groups; kNone of darkness
  std::shared_ptr<IrradianceEngine> engine; ///< null: the group is switched off

  /// What the engine says, in any unit, for the lamps as they shine. With a factor of 1 it is the
  /// same number as before its multiplication.
  double shown(double value, int band) const
  {
    const auto i = static_cast<std::size_t>(band);
    return factor[i] * (scale[i] * value);
  }
};

/**
 * The light of a scene, group by group, see Documentation/Theory.md, 1.6. The lamps of a group are
 * computed as if they were the only ones in the scene, and what they bring is multiplied by the
 * factor of the group. Light adds up: the whole is the sum over the groups in the order of their
 * names. They are independent, so variances add up too.
 *
 * Where there are several groups, or one that has been named, lamps are scaled so that the
 * brightest of a group has 1 in each band. Lamps that all change alike are then the same as before.
 */
class LightGroups
{
public:
  LightGroups() = default;
  LightGroups(const LightGroups&) = delete;
  LightGroups& operator=(const LightGroups&) = delete;

  /// Of a frame. `check(objects, settings)` may throw before the walks of a group are shot.
  struct Asked
  {
    const SceneObjects& objects;
    const std::vector<LampGroup>& groups; ///< by number, see Emission::groups
    std::uint32_t ofSky;                  ///< the group of the sky
    LeftToScene left;                     ///< chosen for each group
    EngineSettings settings; ///< of each group, but for its seed and its part of the time budget
    std::function<void(const SceneObjects&, const EngineSettings&)> check;
  };
  /// Throws what IrradianceEngine does.
  void update(const Asked& asked, Execution& execution);

  /// Those with lamps in the scene, by name.
  const std::vector<LightGroup>& all() const { return groups_; }
  /// Whether there are several, or one that has been named.
  bool areSeveral() const { return areSeveral_; }
  /// The engine of any group that was computed: it knows the scene but for lamps of others.
  const IrradianceEngine& any() const { return *any_; }
  /// Calls visit(group) for each that shines; if none does, for darkness.
  template <class Visit>
  void forEachLit(const Visit& visit) const
  {
    for (const LightGroup* const group : lit_)
    {
      visit(*group);
    }
  }
  /// The sum of value(engine) over these, as it is shown in a band.
  template <class Value>
  double sum(int band, const Value& value) const
  {
    double all = 0;
    forEachLit([&](const LightGroup& group) { all += group.shown(value(*group.engine), band); });
    return all;
  }
  /// The root of the sum of squares of error(engine), likewise.
  template <class Error>
  double sumOfErrors(int band, const Error& error) const
  {
    double square = 0;
    forEachLit([&](const LightGroup& group) {
      square += std::pow(group.shown(error(*group.engine), band), 2);
    });
    return std::sqrt(square);
  }
  /// The sum of number(engine).
  template <class Number>
  auto count(const Number& number) const
  {
    decltype(number(*any_)) all{};
    forEachLit([&](const LightGroup& group) { all += number(*group.engine); });
    return all;
  }
  /// How many groups shine; 1 if none does, see forEachLit().
  std::size_t numberOfLit() const { return lit_.size(); }
  /// The largest of all groups, see IrradianceEngine.
  double reachedRelativeError() const
  {
    double most = 0;
    forEachLit([&](const LightGroup& group) {
      const double reached = group.engine->reachedRelativeError();
      most = std::isnan(reached) || reached > most ? reached : most;
    });
    return most;
  }
  /// W/m2.
  double irradiance(const CellSide& cell, int band) const
  {
    return sum(band, [&](const IrradianceEngine& engine) { return engine.irradiance(cell, band); });
  }

  /// Differs after each update: what was derived from another state is out of date.
  std::uint64_t state() const { return state_; }
  /// Whether the last update was completed.
  bool isValid() const { return isValid_; }

private:
  /// What is kept of a group while its lamps are there.
  struct Member
  {
    GroupLamps lamps;
    std::shared_ptr<IrradianceEngine> engine = std::make_shared<IrradianceEngine>();
  };
  static bool hasSky(const Asked& asked, std::uint32_t number)
  {
    return asked.objects.sky && number == asked.ofSky;
  }
  void findGroups(const Asked& asked, Ranks& ranks);
  /// `budget`: of time, s.
  void updateLit(const Asked& asked, LightGroup& group, double budget, Execution& execution);

  SceneLamps lamps_;
  std::map<std::string, Member> members_; ///< by name of the group
  std::vector<LightGroup> groups_;
  LightGroup darkness_;          ///< has no engine where something shines
  std::vector<LightGroup*> lit_; ///< of these, after an update
  std::shared_ptr<IrradianceEngine> any_;
  bool areSeveral_ = false, isValid_ = false;
  std::uint64_t state_ = 0;
};

/// The error of the light of all groups together; valid until their next update.
class LightGroupErrors
{
public:
  explicit LightGroupErrors(const LightGroups& groups)
    : groups_(groups)
  {
    groups.forEachLit([&](const LightGroup& group) {
      parts_.push_back({ group, group.engine->errorEstimate() });
    });
  }

  // All in W/m2, of cells with an area.
  /// NaN where too few photons arrived.
  double standardError(const CellSide& cell, int band) const;
  /// Of the light of one group; 0 if it is switched off.
  double standardErrorOf(const std::string& group, const CellSide& cell, int band) const
  {
    const auto part = std::find_if(
      parts_.begin(), parts_.end(), [&](const Part& some) { return some.group.name == group; });
    return part == parts_.end() ? 0
                                : shown(*part, cell, band, part->errors.standardError(cell, band));
  }
  /// What a replicate alone says.
  double ofReplicate(const CellSide& cell, int band, std::uint32_t replicate) const
  {
    double sum = 0;
    for (const Part& part : parts_)
    {
      sum += shown(part, cell, band, part.errors.ofReplicate(cell, band, replicate));
    }
    return sum;
  }
  /// What one photon of full power brings: of those groups that bring any the most.
  double ofPhoton(const CellSide& cell, int band) const
  {
    double most = 0, mostOfLit = 0;
    for (const Part& part : parts_)
    {
      const double photon = shown(part, cell, band, part.errors.quantaPerPhoton(cell, band));
      most = std::max(most, photon);
      mostOfLit =
        part.group.engine->irradiance(cell, band) > 0 ? std::max(mostOfLit, photon) : mostOfLit;
    }
    return mostOfLit > 0 ? mostOfLit : most;
  }

private:
  struct Part
  {
    const LightGroup& group;
    ErrorEstimate errors;
  };

  /// As it is shown; `quanta` of a cell.
  static double shown(const Part& part, const CellSide& cell, int band, double quanta)
  {
    const IrradianceEngine& engine = *part.group.engine;
    return part.group.shown(engine.watts(quanta) / engine.cells().area(cell), band);
  }

  const LightGroups& groups_;
  std::vector<Part> parts_;
};

}
