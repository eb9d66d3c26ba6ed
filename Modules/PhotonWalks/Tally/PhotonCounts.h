// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Tally/CellSums.h"

#include <cassert>
#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Photons of one power that one thread adds to sums, or takes back. Each is an increment in a table
 * of the thread's own, and the sums follow at the end. Where the table would be larger than all
 * that is to be counted, photons stand in a list instead.
 */
class PhotonCounts
{
public:
  /// `expected`: about how many photons. `sums` must outlive this.
  PhotonCounts(CellSums& sums, std::int64_t quanta, std::size_t expected)
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
  /// Adds to the sums.
  ~PhotonCounts()
  {
    flush();
    if (table_)
    {
      table_->isTaken = false;
    }
  }
  PhotonCounts(const PhotonCounts&) = delete;
  PhotonCounts& operator=(const PhotonCounts&) = delete;

  /// `slots` may be that of no sum, escaped(), too. `sign`: -1 takes photons back.
  void add(const std::uint32_t* slots, std::size_t count, std::int32_t sign = 1)
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
  /// The slot of photons that no cell receives.
  std::uint32_t escaped() const { return static_cast<std::uint32_t>(sums_.slots()); }

private:
  /// A table of so many slots for each photon takes about as long as the list.
  static constexpr std::size_t kSlotsPerPhoton = 8;
  /// So many photons fit an entry of the table.
  static constexpr std::size_t kMostPhotons = std::size_t{ 1 } << 30;

  void flush()
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

  CellSums& sums_;
  std::int64_t quanta_;
  struct Table
  {
    std::vector<std::int32_t> counts; ///< all 0 between uses, so that it need not be cleared
    bool isTaken = false;
  };
  static Table& tableOfThread()
  {
    static thread_local Table table;
    return table;
  }

  Table* table_ = nullptr;  ///< null if there is a list
  std::size_t counted_ = 0; ///< in the table
  std::vector<Deposit> list_;
};

}
