// SPDX-License-Identifier: BSD-3-Clause
#include "LightGroups.h"

#include "Surfaces/SceneHash.h"

#include <limits>

namespace irradiance
{

namespace
{

constexpr Bands kOne{ { 1, 1, 1 } };

bool isOff(const Bands& factor)
{
  return std::all_of(factor.begin(), factor.end(), [](double of) { return of == 0; });
}

/// So that groups are independent, and none depends on which others there are.
std::uint64_t seedOf(const std::string& name, std::uint64_t seed)
{
  Hash hash;
  hash.add(seed);
  hash.add(std::vector<char>(name.begin(), name.end()));
  return hash.value();
}

}

void LightGroups::findGroups(const Asked& asked, Ranks& ranks)
{
  lamps_.update(asked.objects);
  std::map<std::string, std::uint32_t> present; // by name
  for (std::uint32_t number = 0; number < asked.groups.size(); ++number)
  {
    if (!isOff(lamps_.brightest(number)) || hasSky(asked, number))
    {
      present.emplace(asked.groups[number].name, number);
    }
  }
  areSeveral_ =
    present.size() > 1 || (present.size() == 1 && asked.groups[present.begin()->second].isNamed);
  groups_.clear();
  Hash hash;
  for (const auto& [name, number] : present)
  {
    const Bands& factor = asked.groups[number].factor;
    const bool isScaled = areSeveral_ && !hasSky(asked, number);
    groups_.push_back({ name, factor, isScaled ? lamps_.brightest(number) : kOne, number, {} });
    hash.add(seedOf(name, asked.groups[number].seed.value_or(0)), factor[0], factor[1], factor[2]);
  }
  ranks.expectSame(hash.value(), "other light groups than on the first process");
}

void LightGroups::update(const Asked& asked, Execution& execution)
{
  isValid_ = false;
  ++state_;
  lit_.clear();
  findGroups(asked, execution.ranks());
  std::vector<LightGroup*> lit;
  std::map<std::string, Member> members;
  const auto keep = [&](const LightGroup& group) { members.insert(members_.extract(group.name)); };
  for (LightGroup& group : groups_)
  {
    keep(group);
    if (!isOff(group.factor))
    {
      lit.push_back(&group);
    }
  }
  darkness_ = {};
  if (lit.empty())
  {
    keep(darkness_);
    lit.push_back(&darkness_);
  }
  members_ = std::move(members);
  const double budget = asked.settings.repairTimeBudget;
  double left = budget;
  for (std::size_t i = 0; i < lit.size(); ++i)
  {
    constexpr double kLeast = 1e-9; // s; 0 would be none
    const auto count = static_cast<double>(lit.size()), done = static_cast<double>(i);
    ProgressSpan part(execution, done / count, (done + 1) / count);
    const double share = left / (count - done);
    updateLit(asked, *lit[i], budget > 0 ? std::max(share, kLeast) : 0, part);
    // Processes need the same settings, and have different clocks.
    left -= execution.ranks().areSeveral() ? share : lit[i]->engine->statistics().repairSeconds;
  }
  any_ = lit.front()->engine;
  lit_ = std::move(lit);
  isValid_ = true;
}

void LightGroups::updateLit(
  const Asked& asked, LightGroup& group, double budget, Execution& execution)
{
  Member& member = members_[group.name];
  const SceneObjects objects = member.lamps.only(asked.objects, areSeveral_ ? &lamps_ : nullptr,
    group.number, group.scale, hasSky(asked, group.number));
  EngineSettings settings = asked.settings;
  settings.repairTimeBudget = budget;
  if (group.number < asked.groups.size()) // darkness is none
  {
    settings.seed = asked.groups[group.number].seed.value_or(settings.seed);
  }
  settings.seed = areSeveral_ ? seedOf(group.name, settings.seed) : settings.seed;
  settings = member.engine->chosen(asked.left, objects, settings, execution);
  asked.check(objects, settings);
  member.engine->update(objects, settings, execution);
  group.engine = member.engine;
}

double LightGroupErrors::standardError(const CellSide& cell, int band) const
{
  if (parts_.size() == 1)
  {
    return standardErrorOf(parts_.front().group.name, cell, band);
  }
  double square = 0, doubtful = 0; // of groups whose own error is not known, the largest photon
  for (const Part& part : parts_)
  {
    const double error = shown(part, cell, band, part.errors.standardError(cell, band));
    const double photon = shown(part, cell, band, part.errors.quantaPerPhoton(cell, band));
    // Fewer photons than are needed have a smaller error than so many.
    square += std::isnan(error) ? ErrorEstimate::kFewestPhotons * photon * photon : error * error;
    doubtful = std::isnan(error) ? std::max(doubtful, photon) : doubtful;
  }
  const bool isKnown = groups_.irradiance(cell, band) >= ErrorEstimate::kFewestPhotons * doubtful;
  return isKnown ? std::sqrt(square) : std::numeric_limits<double>::quiet_NaN();
}

}
