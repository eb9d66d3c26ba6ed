// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/Ranks.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

void Ranks::agree(bool isWell)
{
  if (!areSeveral())
  {
    return;
  }
  std::vector<std::int64_t> failed(count(), 0);
  failed[rank()] = isWell ? 0 : 1;
  allReduce(failed.data(), failed.size());
  const auto first = std::find(failed.begin(), failed.end(), 1);
  if (isWell && first != failed.end())
  {
    throw RankFailed("process " + std::to_string(first - failed.begin()) + " of " +
      std::to_string(count()) + " failed or was stopped, so this one stopped too");
  }
}

void Ranks::sum(std::int64_t* numbers, std::size_t size)
{
  if (areSeveral())
  {
    agree(true);
    allReduce(numbers, size);
  }
}

std::vector<std::int64_t> Ranks::concatenate(const std::vector<std::int64_t>& own)
{
  std::vector<std::int64_t> sizes(count(), 0);
  sizes[rank()] = static_cast<std::int64_t>(own.size());
  sum(sizes.data(), sizes.size());
  const auto mine = sizes.begin() + rank();
  // A sum in which each number has one summand.
  std::vector<std::int64_t> all(
    static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), std::int64_t{})));
  std::copy(
    own.begin(), own.end(), all.begin() + std::accumulate(sizes.begin(), mine, std::int64_t{}));
  sum(all.data(), all.size());
  return all;
}

void Ranks::expectSame(std::uint64_t number, const std::string& what)
{
  auto first = rank() == 0 ? static_cast<std::int64_t>(number) : 0;
  sum(&first, 1);
  std::int64_t others = static_cast<std::uint64_t>(first) == number ? 0 : 1;
  sum(&others, 1);
  if (others > 0)
  {
    throw RankFailed(
      what + " on " + std::to_string(others) + " of " + std::to_string(count()) + " processes");
  }
}

void Ranks::together(const std::function<void()>& work)
{
  try
  {
    work();
    agree(true);
  }
  catch (const RankFailed&)
  {
    throw;
  }
  catch (...)
  {
    agree(false);
    throw;
  }
}

}
