// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonSet.h"

#include "Simd/Prefetch.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace irradiance
{

namespace
{

/// Of a table of several buckets. A new one is filled to 3/4. It grows when it is filled to more
/// than 9/10, where photons begin to miss their first bucket often, and shrinks below 1/2.
bool isFull(std::size_t size, std::size_t slots)
{
  return 10 * size > 9 * slots;
}
bool isSparse(std::size_t size, std::size_t slots)
{
  return 2 * size < slots;
}

bool isPrime(std::size_t n)
{
  for (std::size_t divisor = 2; divisor * divisor <= n; ++divisor)
  {
    if (n % divisor == 0)
    {
      return false;
    }
  }
  return true;
}

/// Two multiplications spread each bit of a key over the upper and the lower half.
std::uint64_t hash(std::uint64_t key)
{
  key *= 0x9e3779b97f4a7c15u;
  key ^= key >> 32;
  return key * 0xbf58476d1ce4e5b9u;
}

/// A number below `n` from 32 random bits (Lemire 2019, "Fast random integer generation in an
/// interval").
std::size_t below(std::size_t n, std::uint32_t random)
{
  return random * std::uint64_t{ n } >> 32;
}

/// A bit for each slot that holds `sought`. There is no branch in the loop: it would be
/// mispredicted.
inline unsigned matches(const std::uint64_t* bucket, std::size_t slots, std::uint64_t sought)
{
  unsigned bits = 0;
  for (std::size_t i = 0; i < slots; ++i)
  {
    bits |= static_cast<unsigned>(bucket[i] == sought) << i;
  }
  return bits;
}

/// The buckets where a photon may lie, in order: each once, as every step is coprime with a prime.
class ProbeSequence
{
public:
  ProbeSequence(std::uint64_t key, std::size_t buckets)
    : hash_(hash(key))
    , buckets_(buckets)
    , bucket_(below(buckets, static_cast<std::uint32_t>(hash_ >> 32)))
  {
  }

  std::size_t bucket() const { return bucket_; }
  void next()
  {
    bucket_ += 1 + below(buckets_ - 1, static_cast<std::uint32_t>(hash_));
    bucket_ -= bucket_ < buckets_ ? 0 : buckets_;
  }

private:
  std::uint64_t hash_;
  std::size_t buckets_, bucket_;
};

}

std::size_t PhotonSet::slotsFor(std::size_t size)
{
  if (size <= kBucket)
  {
    // Odd, as blocks of the heap have room for an odd number of keys beside their own header.
    return size == 0 ? 0 : std::clamp(size | 1, std::size_t{ 3 }, kBucket);
  }
  std::size_t buckets = (4 * size + 3 * kBucket - 1) / (3 * kBucket);
  while (!isPrime(buckets))
  {
    ++buckets;
  }
  return buckets * kBucket;
}

std::size_t PhotonSet::findSlot(Key key, Key sought) const
{
  ProbeSequence probe(key, buckets());
  for (std::size_t probes = 0; probes < buckets(); ++probes, probe.next())
  {
    const std::size_t first = probe.bucket() * kBucket;
    const Key* const bucket = table_.get() + first;
    // The constant unrolls the loop.
    const unsigned found =
      slots_ < kBucket ? matches(bucket, slots_, sought) : matches(bucket, kBucket, sought);
    if (found != 0)
    {
      return first + static_cast<std::size_t>(__builtin_ctz(found));
    }
  }
  return kNone;
}

void PhotonSet::insert(const SegmentRef& photon)
{
  assert(!contains(photon));
  reserve(size_ + 1);
  const Key key = keyOf(photon);
  table_[findSlot(key, kEmpty)] = key;
  ++size_;
}

void PhotonSet::remove(const SegmentRef& photon)
{
  const Key key = keyOf(photon);
  const std::size_t slot = findSlot(key, key);
  assert(slot != kNone);
  table_[slot] = kEmpty;
  --size_;
  if (isSparse(size_, slots_) && slotsFor(size_) < slots_)
  {
    resize(slotsFor(size_));
  }
}

bool PhotonSet::contains(const SegmentRef& photon) const
{
  const Key key = keyOf(photon);
  return findSlot(key, key) != kNone;
}

void PhotonSet::reserve(std::size_t size)
{
  if (slots_ <= kBucket ? size > slots_ : isFull(size, slots_))
  {
    resize(slotsFor(size));
  }
}

void PhotonSet::prefetch(const SegmentRef& photon) const
{
  const Key* const first =
    table_.get() + ProbeSequence(keyOf(photon), buckets()).bucket() * kBucket;
  prefetchLine(first);
  prefetchLine(first + kBucket - 1); // buckets need not begin where cache lines do
}

void PhotonSet::resize(std::size_t slots)
{
  PhotonSet resized;
  resized.table_.reset(slots > 0 ? new Key[slots] : nullptr);
  resized.slots_ = slots;
  resized.size_ = size_;
  std::fill_n(resized.table_.get(), slots, kEmpty);
  for (std::size_t i = 0; i < slots_; ++i)
  {
    if (table_[i] != kEmpty)
    {
      resized.table_[resized.findSlot(table_[i], kEmpty)] = table_[i];
    }
  }
  *this = std::move(resized);
}

}
