// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/PhotonCounts.h"

#include <cassert>

namespace irradiance
{

PhotonCounts::Table& PhotonCounts::tableOfThread()
{
  static thread_local Table table;
  return table;
}

PhotonCounts::PhotonCounts(CellSums& sums, std::int64_t quanta, std::size_t expected)
  : sums_(sums)
  , quanta_(quanta)
{
  assert(sums.slots() < 0xffffffffu);
  Table& table = tableOfThread();
  if (sums.slots() / kSlotsPerPhoton <= expected && !table.isTaken)
  {
    table_ = &table;
    table.isTaken = true;
    if (table.counts.size() <= sums.slots())
    {
      table.counts.resize(sums.slots() + 1); // the last entry is for what escapes
    }
  }
}

PhotonCounts::~PhotonCounts()
{
  flush();
  if (table_)
  {
    table_->isTaken = false;
  }
}

void PhotonCounts::add(const std::uint32_t* slots, std::size_t count, std::int32_t sign)
{
  if (!table_)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (slots[i] != escaped())
      {
        list_.push_back({ slots[i], sign * quanta_ });
      }
    }
    return;
  }
  if (counted_ + count > kMostPhotons)
  {
    flush();
  }
  counted_ += count;
  std::int32_t* const table = table_->counts.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    table[slots[i]] += sign;
  }
}

void PhotonCounts::flush()
{
  if (table_ && counted_ > 0)
  {
    sums_.addCounts(table_->counts.data(), quanta_);
    table_->counts[escaped()] = 0;
    counted_ = 0;
  }
  if (!list_.empty())
  {
    sums_.add(list_);
    list_.clear();
  }
}

}
