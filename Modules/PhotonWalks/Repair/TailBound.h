// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TailBound_h
#define irradiance_TailBound_h

#include "Sampling/SobolSequence.h"
#include "Surfaces/Power.h"
#include "Surfaces/SceneObjects.h"

namespace irradiance
{

/**
 * The most that the rest of a walk can bring to all cells together, wherever it goes: what it
 * brings if it never escapes and always hits the cell that reflects most. Whether it survives a hit
 * is decided by its own samples, so the bound is certain, not a mean. See Documentation/Theory.md,
 * 4.1.
 */
class TailBound
{
public:
  TailBound(const SceneObjects& objects, const SobolSequence& samples);

  /// False if a material reflects more than kMostReflecting: then no bound is known.
  bool isKnown() const { return reflectance_ <= kMostReflecting; }
  /// Quanta in any one band, if isKnown(). `incoming`: what segment `bounce` carries.
  std::int64_t operator()(std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const;

private:
  /// Beyond this the bound would take long, and be a hundred times the power or more.
  static constexpr double kMostReflecting = 0.99;

  SobolSequence samples_;
  double reflectance_ = 0; ///< the largest of any triangle
};

}

#endif
