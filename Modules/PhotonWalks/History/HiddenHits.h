// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_HiddenHits_h
#define irradiance_HiddenHits_h

#include "Geometry/Ray.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace irradiance
{

/// The closest static hit along the ray of a segment that ends before it, on a dynamic object.
struct HiddenHit
{
  static constexpr std::uint32_t kUnknown = 0xfffffffeu; ///< not TriangleId::kNone, which is known

  double distance = kInfinity;
  std::uint32_t triangle = kUnknown; ///< kNone if nothing static is hit
  float weights[2] = { 0, 0 };

  bool isKnown() const { return triangle != kUnknown; }
};

/**
 * The cache of static hits of a block (section 3.3 of the paper), by slot. A hit is kept as long as
 * a dynamic object hides it; when the object has moved away, the static tree need not be searched.
 */
class HiddenHits
{
public:
  bool isEmpty() const { return hits_.empty(); }
  HiddenHit find(std::uint32_t slot) const
  {
    const auto found = hits_.find(slot);
    return found == hits_.end() ? HiddenHit{} : found->second;
  }
  void set(std::uint32_t slot, const HiddenHit& hit) { hits_[slot] = hit; }
  void forget(std::uint32_t slot) { hits_.erase(slot); }
  void forgetAll() { hits_.clear(); }
  std::size_t bytes() const
  {
    return hits_.size() * (sizeof(decltype(hits_)::value_type) + 2 * sizeof(void*)) +
      hits_.bucket_count() * sizeof(void*);
  }

private:
  std::unordered_map<std::uint32_t, HiddenHit> hits_;
};

}

#endif
