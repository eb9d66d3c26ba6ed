// SPDX-License-Identifier: BSD-3-Clause
#include "Input/SceneAdvice.h"

#include "FinalGather/CellRoles.h"
#include "Input/CoveredLamps.h"
#include "Progress/InputError.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// A part has to be larger than this, and several times as large as all static ones, m.
constexpr double kLargePart = 10, kMuchLarger = 2;
/// A scene has to be larger than this, m, and to have less light than this, W/m2 on the average.
constexpr double kLargeScene = 100, kThinLight = 1e-3;
/// With fewer walks it says little that nothing was hit.
constexpr std::uint32_t kFewWalks = 1000;

/// Five digits are enough for a message.
std::string rounded(double value)
{
  std::ostringstream stream;
  stream.precision(5);
  stream << value;
  return stream.str();
}

bool isInside(const Box& box, const Box& outer)
{
  const Box common = box.intersection(outer);
  return common.lower == box.lower && common.upper == box.upper;
}

/// A part of the scene, in the world.
struct AdvisedPart
{
  const std::string* name;
  std::uint32_t object;
  double watts = 0; ///< that its surfaces emit
  Box emitting{}, dark{};

  Box bounds() const
  {
    Box both = emitting;
    both.add(dark);
    return both;
  }
};

class SceneAdvice
{
public:
  SceneAdvice(const SceneInputs& inputs, const SceneReader& scene, const LightGroups& groups,
    const CancelPoint& cancelPoint)
    : scene_(scene)
    , objects_(scene.objects())
    , groups_(groups)
    , engine_(groups.any())
    , cancelPoint_(cancelPoint)
  {
    groups.forEachLit([&](const LightGroup& group) {
      const auto its = findCoveredLamps(group, groups.areSeveral(), cancelPoint);
      covered_.insert(covered_.end(), its.begin(), its.end());
    });
    // Small closed rooms, as most are, pay no more than this.
    if (escaped() > 0 || objects_.worldBounds().size() > kLargePart || !covered_.empty() ||
      isUnlit())
    {
      findParts(inputs);
    }
  }

  std::vector<std::string> warnings() const
  {
    std::vector<std::string> warnings{ sideWarning(), coverWarning(), partLengthWarning() };
    if (warnings.back().empty()) // else it has been said
    {
      warnings.push_back(sceneLengthWarning());
    }
    warnings.push_back(readingWarning());
    warnings.erase(std::remove(warnings.begin(), warnings.end(), ""), warnings.end());
    return warnings;
  }

private:
  /// W, of all bands.
  double watts(Power PowerBalance::*power) const
  {
    double sum = 0;
    for (int band = 0; band < scene_.bands(); ++band)
    {
      sum += groups_.sum(band, [&](const IrradianceEngine& engine) {
        return engine.watts((engine.balance().*power)[band]);
      });
    }
    return sum;
  }

  double escaped() const
  {
    // Gathered light is an estimate: what so little of it says may be noise.
    constexpr double kSure = 5;
    const double watts = this->watts(&PowerBalance::escaped);
    double noise = 0;
    for (int band = 0; engine_.settings().gathersDirectLight && band < scene_.bands(); ++band)
    {
      noise += kSure * groups_.sumOfErrors(band, [band](const IrradianceEngine& engine) {
        return engine.escapedError(band);
      });
    }
    return watts < noise ? 0 : watts;
  }

  /// Calls visit(part, cell, triangle in the world) for all that is there.
  template <class Visit>
  void forEachTriangle(const Visit& visit) const
  {
    ThrottledCancelPoint pace(cancelPoint_);
    for (std::uint32_t object = 0; object < objects_.size(); ++object)
    {
      const SceneObject& placed = objects_[object];
      for (std::size_t i = 0; !placed.isEmpty() && i < placed.body->mesh().triangles().size(); ++i)
      {
        pace.step();
        const std::size_t cell = placed.material->cellOfTriangle[i];
        visit(scene_.partOf({ object, cell }), cell,
          transformed(placed.worldFromObject, placed.body->mesh().triangles()[i]));
      }
    }
  }

  void findParts(const SceneInputs& inputs)
  {
    for (const InputPart* part : allPartsOf(inputs))
    {
      parts_.push_back({ &part->name, scene_.firstCellOf(parts_.size()).object });
    }
    forEachTriangle([&](std::size_t part, std::size_t cell, const Triangle& triangle) {
      AdvisedPart& at = parts_[part];
      const SceneObject& object = objects_[at.object];
      const bool isLamp = object.hasExitance(cell);
      (isLamp ? at.emitting : at.dark).add(triangle.bounds());
      for (int band = 0; isLamp && band < object.emission->bands; ++band)
      {
        at.watts += triangle.area() * object.exitanceOf(cell)[band];
      }
    });
  }

  /// Whether there are surfaces that are no lamps, and not one of them has received a photon.
  bool isUnlit() const
  {
    bool hasOthers = false;
    ThrottledCancelPoint pace(cancelPoint_);
    for (std::uint32_t object = 0; object < objects_.size(); ++object)
    {
      const std::size_t cells = objects_[object].material->numberOfCells;
      for (SceneCell cell{ object, 0 }; cell.cell < cells; ++cell.cell)
      {
        pace.step();
        if (!(engine_.cells().area(cell) > 0) || objects_[object].hasExitance(cell.cell))
        {
          continue;
        }
        hasOthers = true;
        for (int band = 0; band < scene_.bands(); ++band)
        {
          if (groups_.count(
                [&](const auto& engine) { return engine.sums().sum({ cell }, band); }) != 0)
          {
            return false;
          }
        }
      }
    }
    return hasOthers && engine_.numberOfWalks() >= kFewWalks;
  }

  /// The surfaces that are no lamps of this part.
  Box allBut(std::size_t part) const
  {
    Box box = parts_[part].dark;
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      box.add(i == part ? Box() : parts_[i].bounds());
    }
    return box;
  }

  /// Parts of which every lamp has all the rest of the scene behind it, by the boxes around these.
  std::vector<bool> partsThatFaceAway() const
  {
    std::vector<bool> faceAway(parts_.size()), haveBehind(parts_.size());
    std::vector<Box> others(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      faceAway[i] = parts_[i].watts > 0;
      others[i] = faceAway[i] ? allBut(i) : Box();
      faceAway[i] = faceAway[i] && !others[i].isEmpty();
    }
    forEachTriangle([&](std::size_t part, std::size_t cell, const Triangle& triangle) {
      if (!faceAway[part] || !objects_[parts_[part].object].hasExitance(cell))
      {
        return;
      }
      constexpr double flat = 1e-6; // in sizes: in the plane is neither before nor behind
      const Vector3 normal = triangle.areaVector().stableNormalized();
      const double middle = normal.dot(others[part].center() - triangle.a);
      const double reach = 0.5 * normal.cwiseAbs().dot(others[part].extent());
      const double tolerance = flat * (reach + std::abs(middle));
      faceAway[part] = middle + reach <= tolerance;
      haveBehind[part] = haveBehind[part] || middle - reach < -tolerance;
    });
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      faceAway[i] = faceAway[i] && haveBehind[i];
    }
    return faceAway;
  }

  /// Open scenes lose much light, so a lamp has to lose all of its own; or lamps keep all of it.
  std::string sideWarning() const
  {
    const double escaped = this->escaped();
    const bool isKept = !(escaped > 0) && isUnlit();
    const std::vector<bool> faceAway =
      escaped > 0 ? partsThatFaceAway() : std::vector<bool>(parts_.size());
    double watts = 0;
    std::string names;
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      // From its other side, a lamp that keeps its light could reach only what is outside of it.
      if (parts_[i].watts > 0 &&
        ((faceAway[i] && escaped >= 0.5 * parts_[i].watts) ||
          (isKept && !isInside(allBut(i), parts_[i].emitting))))
      {
        watts += parts_[i].watts;
        names += (names.empty() ? "" : "; ") + *parts_[i].name;
      }
    }
    return names.empty()
      ? ""
      : "nothing else is lit by these lamps of " + rounded(watts) + " W: " + names +
        ". A cell emits from its front, the side from which its points run counter-clockwise; "
        "if the other side was meant, reverse the cells (vtkReverseSense)";
  }

  std::string coverWarning() const
  {
    std::string names;
    for (const CoveredLamps& its : covered_)
    {
      names += (names.empty() ? "" : "; ") + *parts_[scene_.partOf(its.lamp)].name + " (" +
        rounded(its.watts) + " W, about " + std::to_string(std::lround(100 * its.covered)) +
        " % of what is bound for surfaces, behind lamps of " +
        *parts_[scene_.partOf(its.cover)].name + ")";
    }
    return names.empty() ? ""
                         : "these lamps shine on the backs of lamps: " + names +
        ". A lamp stops light as any surface does: a sun has to stand within its sky, a bulb "
        "outside of a cover that shines itself";
  }

  std::string partLengthWarning() const
  {
    Box all;
    bool hasSurfaces = false;
    const std::size_t statics = std::min(scene_.numberOfStatics(), parts_.size());
    for (std::size_t i = 0; i < statics; ++i)
    {
      all.add(parts_[i].bounds());
      hasSurfaces = hasSurfaces || !parts_[i].dark.isEmpty();
    }
    for (std::size_t i = statics; hasSurfaces && i < parts_.size(); ++i)
    {
      const Box part = parts_[i].bounds();
      const double size = part.size();
      if (size > kLargePart && size > kMuchLarger * all.size() && !part.intersection(all).isEmpty())
      {
        return *parts_[i].name + " is " + rounded(size) + " m large, in a static scene of " +
          rounded(all.size()) +
          " m: if its points are in millimetres, scale it by 0.001 in its transform";
      }
    }
    return {};
  }

  /// Point lights, or lamps in metres, spread thinly over walls in millimetres. If all is in
  /// millimetres and lamps have an exitance, the irradiance is right.
  std::string sceneLengthWarning() const
  {
    Box scene;
    const AdvisedPart* largest = nullptr;
    for (const AdvisedPart& part : parts_)
    {
      scene.add(part.bounds());
      largest = largest && largest->bounds().size() >= part.bounds().size() ? largest : &part;
    }
    if (!(scene.size() > kLargeScene))
    {
      return {};
    }
    double area = 0;
    engine_.cells().numbers().forEach(
      [&](const SceneCell& cell) { area += engine_.cells().area(cell); });
    const double emitted = watts(&PowerBalance::emitted);
    if (!(emitted > 0 && emitted < kThinLight * area))
    {
      return {};
    }
    return "the scene is " + rounded(scene.size()) + " m large, most of it " + *largest->name +
      " with " + rounded(largest->bounds().size()) + " m, so that its " + rounded(emitted) +
      " W are " + rounded(emitted / area) +
      " W/m2 on the average of its surfaces: if points are in millimetres, scale them by 0.001 "
      "(vtkTransformPolyDataFilter)";
  }

  /// A final gather in which all cells expect so few photons that none is read.
  std::string readingWarning() const
  {
    const EngineSettings& settings = engine_.settings();
    if (settings.cellEstimate != CellEstimate::Gathered || settings.unbiasedGather)
    {
      return {};
    }
    const std::uint32_t walks = engine_.walks().plan().walksAfter(1);
    const CellRoles roles(engine_.cells(), walks, settings.gatherRays, settings.gathersEverywhere);
    double largest = 0; // m2
    engine_.cells().numbers().forEach(
      [&](const SceneCell& cell) { largest = std::max(largest, engine_.cells().area(cell)); });
    const double expected = roles.expectedOn(largest);
    return largest == 0 || expected >= roles.fewestToRead()
      ? ""
      : "Method Gathered finds no cell to read: of " + std::to_string(walks) +
        " walks the largest cell expects " + rounded(expected) + ", and " +
        rounded(roles.fewestToRead()) +
        " are needed, so each ray goes on and looks for the lights wherever it hits, which takes "
        "longer and is noisier: multiply NumberOfWalks by " +
        rounded(std::ceil(roles.fewestToRead() / expected)) +
        " at least, or say by Method PathTraced that this is meant";
  }

  const SceneReader& scene_;
  const SceneObjects& objects_;
  const LightGroups& groups_;
  const IrradianceEngine& engine_; ///< of any group
  const CancelPoint& cancelPoint_;
  std::vector<CoveredLamps> covered_;
  std::vector<AdvisedPart> parts_; ///< all, in order; empty where there is nothing to say
};

}

std::string excessWarning(double emitted, double escaped, double error)
{
  return !isExcess(emitted, escaped, error)
    ? ""
    : "light comes out of nothing: " + rounded(emitted - escaped) + " W are absorbed of " +
      rounded(emitted) + " W, and the standard error is " + rounded(error) +
      " W. Gathered light is an estimate that fails here: let Method be Walks, where no light "
      "is lost";
}

std::vector<std::string> sceneAdvice(const SceneInputs& inputs, const SceneReader& scene,
  const LightGroups& groups, const CancelPoint& cancelPoint)
{
  return SceneAdvice(inputs, scene, groups, cancelPoint).warnings();
}

}
