// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiance
{

/// Another rank has failed, or was interrupted.
class RankFailed : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/**
 * The processes that compute a scene together. Each of them has the whole scene, and calls the
 * engine with the same as the others, in the same order. This one is alone.
 *
 * Before each sum over the ranks all of them agree that nobody has failed. So a rank that throws
 * ends the work of all, and none waits for it.
 */
class Ranks
{
public:
  virtual ~Ranks() = default;

  virtual std::uint32_t rank() const { return 0; }
  virtual std::uint32_t count() const { return 1; }
  bool areSeveral() const { return count() > 1; }

  /// Replaces numbers by their sums over all ranks. Throws RankFailed.
  void sum(std::int64_t* numbers, std::size_t size)
  {
    if (areSeveral())
    {
      agree(true);
      allReduce(numbers, size);
    }
  }
  /// The numbers of all ranks, one rank after the other. Throws RankFailed.
  std::vector<std::int64_t> concatenate(const std::vector<std::int64_t>& own)
  {
    std::vector<std::int64_t> ends(count(), 0); // of each rank's
    ends[rank()] = static_cast<std::int64_t>(own.size());
    sum(ends.data(), ends.size());
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    // A sum in which each number has one summand.
    std::vector<std::int64_t> all(static_cast<std::size_t>(ends.back()));
    std::copy_backward(own.begin(), own.end(), all.begin() + ends[rank()]);
    sum(all.data(), all.size());
    return all;
  }
  /// Throws RankFailed if this number is another one on some rank. `what` are its words for the
  /// user.
  void expectSame(std::uint64_t number, const std::string& what)
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
  /// Does work in which ranks sum up. If one of them throws, all others throw RankFailed.
  void together(const std::function<void()>& work)
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
  /// In place of the work that the others do together; it fails for them.
  void withdraw() { agree(false); }

private:
  /// Throws RankFailed if another rank is not well.
  void agree(bool isWell)
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
  /// The sums, modulo 2^64, without further ado.
  virtual void allReduce(std::int64_t* /*numbers*/, std::size_t /*size*/) {}
};

}
