// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontDescent_h
#define irradiance_FrontDescent_h

#include "Kernels/FrontStages.h"
#include "Simd/Column.h"

namespace irradiance
{

/**
 * The first stages of a cast in one tree, each a loop over all rays: prepare and search. The first
 * reference that a search finds goes to a column, others, which are few, to a list. Rays that
 * floats cannot follow are searched in double, one by one. What is found is for the caller to
 * confirm.
 *
 * Owns the memory of the stages, which is used again from call to call.
 */
class FrontDescent
{
public:
  /// What lies in memory for references, to prefetch.
  struct Rows
  {
    const char* first;
    std::size_t bytes; ///< from one to the next
    std::size_t read;  ///< of one
  };

  /// `tester`: is given what must be tested at once.
  void run(const TriangleTree& tree, const TreeRays& rays, const Rows& rows, FrontTester& tester);

  /// By ray, the first reference found, or kNone; to TreeRays::roomFor().
  const std::uint32_t* candidates() const { return candidate_.data(); }
  const FurtherCandidate* further() const { return further_.data(); }
  std::uint32_t furtherCount() const { return furtherCount_; }

private:
  Column<PreparedQuery> queries_;
  Column<std::uint32_t> others_, candidate_;
  Column<FurtherCandidate> further_;
  std::uint32_t furtherCount_ = 0;
};

}

#endif
