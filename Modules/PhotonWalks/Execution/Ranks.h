// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Ranks_h
#define irradiance_Ranks_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiance
{

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
  void sum(std::int64_t* numbers, std::size_t size);
  /// The numbers of all ranks, one rank after the other. Throws RankFailed.
  std::vector<std::int64_t> concatenate(const std::vector<std::int64_t>& own);
  /// Throws RankFailed if this number is another one on some rank. `what` are its words for the
  /// user.
  void expectSame(std::uint64_t number, const std::string& what);
  /// Does work in which ranks sum up. If one of them throws, all others throw RankFailed.
  void together(const std::function<void()>& work);
  /// In place of the work that the others do together; it fails for them.
  void withdraw() { agree(false); }

private:
  /// Throws RankFailed if another rank is not well.
  void agree(bool isWell);
  /// The sums, modulo 2^64, without further ado.
  virtual void allReduce(std::int64_t* /*numbers*/, std::size_t /*size*/) {}
};

/// Another rank has failed, or was interrupted.
class RankFailed : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

}

#endif
