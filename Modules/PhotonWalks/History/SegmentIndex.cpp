// SPDX-License-Identifier: BSD-3-Clause
#include "History/SegmentIndex.h"

#include "Simd/SimdLevel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

constexpr std::size_t kFanout = IndexScan::kFanout;
constexpr std::size_t kTop = kFanout * kFanout; // segments

std::size_t roundedUp(std::size_t size, std::size_t step)
{
  return (size + step - 1) / step * step;
}

constexpr unsigned kKeyBits = 5; // of each of the six coordinates

/// The bits of a number, six places apart.
std::array<std::uint32_t, 1u << kKeyBits> spreadBits()
{
  std::array<std::uint32_t, 1u << kKeyBits> spread{};
  for (std::uint32_t number = 0; number < spread.size(); ++number)
  {
    for (unsigned bit = 0; bit < kKeyBits; ++bit)
    {
      spread[number] |= (number >> bit & 1u) << 6 * bit;
    }
  }
  return spread;
}

/// The first bits of all coordinates of both ends, interleaved: segments with equal upper bits are alike.
std::uint32_t keyOf(const BouncePage& page, std::uint32_t place)
{
  static const auto spread = spreadBits();
  std::uint32_t key = 0;
  for (const auto& column : page.ends)
  {
    const auto upwards = static_cast<std::uint16_t>(column[place] ^ 0x8000);
    key = key << 1 | spread[static_cast<unsigned>(upwards) >> (16 - kKeyBits)];
  }
  return key;
}

/// By the upper half, of 30 bits.
void sortByKey(std::vector<std::uint64_t>& keys)
{
  constexpr unsigned kDigit = 10;
  std::vector<std::uint64_t> other(keys.size());
  for (unsigned shift = 32; shift < 32 + 3 * kDigit; shift += kDigit)
  {
    std::array<std::size_t, (1u << kDigit) + 1> first{};
    const auto digit = [&](std::uint64_t key) { return key >> shift & ((1u << kDigit) - 1); };
    for (const std::uint64_t key : keys)
    {
      ++first[digit(key) + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::uint64_t key : keys)
    {
      other[first[digit(key)]++] = key;
    }
    keys.swap(other);
  }
}

/// Overwrites them; by halves, as lanes can do it.
template <std::size_t kCount>
float largestOf(float (&numbers)[kCount])
{
  for (std::size_t half = kCount / 2; half > 0; half /= 2)
  {
    for (std::size_t i = 0; i < half; ++i)
    {
      numbers[i] = numbers[i] > numbers[half + i] ? numbers[i] : numbers[half + i];
    }
  }
  return numbers[0];
}

}

void SegmentIndex::Columns::resize(std::size_t size)
{
  for (auto& column : ends)
  {
    column.resize(size);
  }
  references.resize(size, kNothing);
}

IndexColumns SegmentIndex::Columns::view() const
{
  return { { ends[0].data(), ends[1].data(), ends[2].data(), ends[3].data(), ends[4].data(),
             ends[5].data() },
    radius.data() };
}

std::size_t SegmentIndex::Columns::bytes() const
{
  std::size_t bytes = radius.capacity() * sizeof(float) + references.capacity() * sizeof(kNothing);
  for (const auto& column : ends)
  {
    bytes += column.capacity() * sizeof(std::int16_t);
  }
  return bytes;
}

std::vector<std::uint64_t> SegmentIndex::sortedKeys(const Blocks& blocks) const
{
  std::vector<std::uint64_t> keys;
  for (std::uint32_t b = 0; b < blocks.size(); ++b)
  {
    assert(blocks[b]->slots() < 1u << kSlotBits);
    blocks[b]->forEach([&](std::uint32_t slot) {
      const BouncePage& page = *blocks[b]->pages()[slot / BouncePage::kSize];
      const std::uint64_t key = keyOf(page, slot % BouncePage::kSize);
      keys.push_back(key << 32 | b << kSlotBits | slot);
    });
  }
  sortByKey(keys);
  return keys;
}

template <std::size_t kCount>
SegmentIndex::Columns SegmentIndex::groupsOf(const Columns& members)
{
  Columns groups;
  const std::size_t size = members.references.size() / kCount;
  groups.resize(size);
  groups.references = {};
  groups.radius.resize(size);
  for (std::size_t group = 0; group < size; ++group)
  {
    float squares[2][kCount] = {}; // of the distances of both ends
    for (int column = 0; column < 6; ++column)
    {
      const std::int16_t* const ends = members.ends[column].data() + group * kCount;
      std::int16_t least = ends[0], most = ends[0];
      for (std::size_t i = 0; i < kCount; ++i)
      {
        least = std::min(least, ends[i]);
        most = std::max(most, ends[i]);
      }
      const int middle = (least + most) / 2;
      groups.ends[column][group] = static_cast<std::int16_t>(middle);
      for (std::size_t i = 0; i < kCount; ++i)
      {
        const auto off = static_cast<float>(ends[i] - middle);
        squares[column / 3][i] += off * off;
      }
    }
    constexpr float kMore = 1 + 0x1p-20F; // pays for the rounding
    groups.radius[group] =
      std::sqrt(std::max(largestOf<kCount>(squares[0]), largestOf<kCount>(squares[1]))) * kMore;
  }
  return groups;
}

SegmentIndex::SegmentIndex(const Blocks& blocks)
{
  assert(blocks.size() <= kBlocks);
  const std::vector<std::uint64_t> keys = sortedKeys(blocks);
  sorted_.resize(keys.empty() ? 0 : roundedUp(keys.size(), kTop * kFanout));
  for (std::size_t i = 0; i < sorted_.references.size(); ++i)
  {
    const auto reference = static_cast<std::uint32_t>(keys[std::min(i, keys.size() - 1)]);
    const std::uint32_t slot = reference & ((1u << kSlotBits) - 1);
    const BouncePage& page = *blocks[reference >> kSlotBits]->pages()[slot / BouncePage::kSize];
    sorted_.references[i] = i < keys.size() ? reference : kNothing;
    for (int column = 0; column < 6; ++column)
    {
      sorted_.ends[column][i] = page.ends[column][slot % BouncePage::kSize];
    }
  }
  groups_ = groupsOf<kFanout>(sorted_);
  tops_ = groupsOf<kTop>(sorted_);
}

void SegmentIndex::add(
  const Blocks& blocks, std::size_t block, const std::uint32_t* slots, std::size_t count)
{
  tail_.resize(roundedUp(inTail_ + count, kFanout));
  for (std::size_t i = 0; i < count; ++i, ++inTail_)
  {
    const BouncePage& page = *blocks[block]->pages()[slots[i] / BouncePage::kSize];
    tail_.references[inTail_] = static_cast<std::uint32_t>(block) << kSlotBits | slots[i];
    for (int column = 0; column < 6; ++column)
    {
      tail_.ends[column][inTail_] = page.ends[column][slots[i] % BouncePage::kSize];
    }
  }
}

/// Another segment may be stored in its slot by now, which has its own entry. If it has the same ends, it
/// does not matter which.
void SegmentIndex::flagEntry(
  const Blocks& blocks, const Columns& entries, std::size_t entry, Flags& flagged) const
{
  const std::uint32_t reference = entries.references[entry];
  if (reference == kNothing)
  {
    return;
  }
  const std::uint32_t block = reference >> kSlotBits, slot = reference & ((1u << kSlotBits) - 1);
  const BouncePage& page = *blocks[block]->pages()[slot / BouncePage::kSize];
  const std::uint32_t place = slot % BouncePage::kSize;
  bool isSame = page.tags[place] != BounceTag::kFree;
  for (int column = 0; column < 6; ++column)
  {
    isSame = isSame & (page.ends[column][place] == entries.ends[column][entry]);
  }
  std::uint16_t& word = flagged[block][slot / PageScan::kGroupSize];
  word = static_cast<std::uint16_t>(word | (isSame ? 1u : 0u) << slot % PageScan::kGroupSize);
}

void SegmentIndex::find(const Blocks& blocks, const BounceScan& scan,
  std::vector<std::vector<std::uint32_t>>& slots) const
{
  slots.resize(blocks.size());
  if (scan.flagsAll())
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      BounceScan::listAll(*blocks[b], slots[b]);
    }
    return;
  }
  static thread_local std::vector<std::vector<std::uint16_t>> flagged;
  flagged.resize(std::max(flagged.size(), blocks.size()));
  flagTags(blocks, scan, flagged);
  flagNear(blocks, scan, flagged);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    BounceScan::listFlagged(flagged[b], slots[b]);
  }
}

/// Of all segments: a tag is a byte.
void SegmentIndex::flagTags(const Blocks& blocks, const BounceScan& scan, Flags& flagged) const
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const auto& pages = blocks[b]->pages();
    flagged[b].resize(pages.size() * PageScan::kGroups);
    const PageScan tags{ pages.data(), pages.size(), nullptr, scan.tags(), {}, nullptr,
      flagged[b].data() };
    IRRADIANCE_CALL_BEST(scanPages, tags);
  }
}

void SegmentIndex::flagNear(const Blocks& blocks, const BounceScan& scan, Flags& flagged) const
{
  const std::size_t bodies = scan.bodies().count;
  std::vector<std::uint32_t> ofTop(bodies + 1), ofGroup(bodies + 1);
  std::vector<NearBody> near(bodies + 1);
  std::vector<std::uint16_t> nearTops(bodies), nearGroups(bodies);
  static thread_local std::vector<std::uint32_t> found;
  found.resize(sorted_.references.size() + tail_.references.size());
  const IndexScan search{ sorted_.view(), groups_.view(), tops_.view(), tops_.radius.size(),
    tail_.view(), tail_.references.size(), scan.bodies(), nearTops.data(), nearGroups.data(),
    ofTop.data(), ofGroup.data(), near.data(), found.data() };
  const std::size_t count = IRRADIANCE_CALL_BEST(scanIndex, search);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t all = sorted_.references.size();
    found[i] < all ? flagEntry(blocks, sorted_, found[i], flagged)
                   : flagEntry(blocks, tail_, found[i] - all, flagged);
  }
}

std::size_t SegmentIndex::bytes() const
{
  return sizeof(*this) + sorted_.bytes() + groups_.bytes() + tops_.bytes() + tail_.bytes();
}

}
