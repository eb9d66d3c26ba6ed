// SPDX-License-Identifier: BSD-3-Clause
#ifndef PhotonBags_h
#define PhotonBags_h

#include "Rivals/PhotonSet.h"

#include <algorithm>
#include <functional>
#include <unordered_set>
#include <vector>

/// What may hold the photons of a cell, each with the same few functions.
using irradiance::SegmentRef;

struct OurBag : irradiance::PhotonSet
{
  static constexpr const char* kName = "PhotonSet";

  std::size_t memory() const { return sizeof(*this) + bytes(); }
};

/// The standard library's hash table.
class StandardBag
{
public:
  static constexpr const char* kName = "std::unordered_set";

  void reserve(std::size_t size) { photons_.reserve(size); }
  void prefetch(const SegmentRef&) const {}
  void insert(const SegmentRef& photon) { photons_.insert(photon); }
  void remove(const SegmentRef& photon) { photons_.erase(photon); }
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    std::for_each(photons_.begin(), photons_.end(), visit);
  }
  /// Each node is a block of the heap, with its header.
  std::size_t memory() const
  {
    return sizeof(*this) + photons_.bucket_count() * sizeof(void*) + photons_.size() * 32;
  }

private:
  struct Hash
  {
    std::size_t operator()(const SegmentRef& photon) const
    {
      return (std::size_t{ photon.walk } << 20 ^ photon.bounce) * 0x9e3779b97f4a7c15u >> 20;
    }
  };

  std::unordered_set<SegmentRef, Hash> photons_;
};

/// No table at all: what is to be removed is looked for from the first photon on.
class PlainBag
{
public:
  static constexpr const char* kName = "std::vector";

  void reserve(std::size_t size) { photons_.reserve(size); }
  void prefetch(const SegmentRef&) const
  {
    irradiance::prefetchLine(photons_.data());
    irradiance::prefetchLine(photons_.data() + photons_.size());
  }
  void insert(const SegmentRef& photon) { photons_.push_back(photon); }
  void remove(const SegmentRef& photon)
  {
    *std::find(photons_.begin(), photons_.end(), photon) = photons_.back();
    photons_.pop_back();
  }
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    std::for_each(photons_.begin(), photons_.end(), visit);
  }
  std::size_t memory() const { return sizeof(*this) + photons_.capacity() * sizeof(photons_[0]); }

private:
  std::vector<SegmentRef> photons_;
};

#endif
