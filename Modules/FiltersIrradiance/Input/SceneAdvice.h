// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneAdvice_h
#define irradiance_SceneAdvice_h

#include "Input/CoveredLamps.h"
#include "Input/InputConnection.h"
#include "Input/SceneReader.h"
#include "IrradianceEngine.h"

#include <string>
#include <vector>

namespace irradiance
{

/// Says where more light arrived than there is; empty if that may be noise. W in a band; `error`:
/// the standard error of what escaped.
std::string excessWarning(double emitted, double escaped, double error);

/**
 * Finds scenes that can be computed but are hardly meant, and says what was probably meant: lamps
 * that shine away from everything or on the backs of others, millimetres where metres are read, and
 * so few walks that rays find nothing to read. Documentation/Extremes.md has the limits and says
 * what is legitimate beyond them.
 */
class SceneAdvice
{
public:
  /// After an update of `engine` with `scene`, which has read these inputs. All of them must
  /// outlive it.
  SceneAdvice(const std::vector<InputConnection>& statics,
    const std::vector<InputConnection>& dynamics, const SceneReader& scene,
    const IrradianceEngine& engine, const CancelPoint& cancelPoint);

  /// Warnings, a sentence or two each.
  std::vector<std::string> warnings() const;

  /// A part has to be larger than this, and several times as large as all static ones, m.
  static constexpr double kLargePart = 10;
  static constexpr double kMuchLarger = 2;
  /// A scene has to be larger than this, m, and to have less light than this, W/m2 on the average.
  static constexpr double kLargeScene = 100;
  static constexpr double kThinLight = 1e-3;
  /// With fewer walks it says little that nothing was hit.
  static constexpr std::uint32_t kFewWalks = 1000;

private:
  /// A part of the scene, in the world.
  struct Part
  {
    const std::string* name;
    std::uint32_t object;
    double watts = 0; ///< that its surfaces emit
    Box emitting, dark;
    Box bounds() const
    {
      Box both = emitting;
      both.add(dark);
      return both;
    }
  };

  template <class Visit>
  void forEachTriangle(const Visit& visit) const;
  void findParts(
    const std::vector<InputConnection>& statics, const std::vector<InputConnection>& dynamics);
  double emitted() const; ///< W, of all bands
  double escaped() const;
  bool isUnlit() const;
  std::vector<bool> partsThatFaceAway() const;
  Box allBut(std::size_t part) const;
  std::string sideWarning() const;
  std::string coverWarning() const;
  const std::string& partNameOf(const SceneCell& cell) const;
  std::string partLengthWarning() const;
  std::string sceneLengthWarning() const;
  std::string readingWarning() const;

  const SceneReader& scene_;
  const SceneObjects& objects_;
  const IrradianceEngine& engine_;
  const CancelPoint& cancelPoint_;
  std::vector<CoveredLamps> covered_;
  /// The static ones, then the dynamic ones. Empty where there is nothing to say.
  std::vector<Part> parts_;
  std::size_t statics_ = 0; ///< how many are static
};

}

#endif
