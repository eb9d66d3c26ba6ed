// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ErrorControlledIntegral_h
#define irradiance_ErrorControlledIntegral_h

#include "Time/ExposureIntegral.h"
#include "Time/ExposureNode.h"
#include "Time/ExposureTimes.h"
#include "Time/TimeHalving.h"

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace irradiance
{

/**
 * The trapezoidal rule over pairs of intervals that are halved, the worst pair first, until their error, as
 * estimated, is small enough. Documentation/Theory.md, 5.6.
 *
 * The first times are visited in order. Then the two intervals of the worst pair are visited in their
 * middles, which makes a pair of each. All decisions follow from the irradiance, so the times do too.
 *
 * Only the times of pairs that may yet be halved are held. A settled pair is added up, and its sums wait for
 * those of its neighbour: of the other half of what was halved, or, from a pair of the first times upwards,
 * of the other half of a range of such pairs. So the order of additions does not depend on what was settled
 * when.
 */
class ErrorControlledIntegral : public ExposureIntegral
{
public:
  /// `firstTimes`: in order, an odd number from 3 on.
  ErrorControlledIntegral(std::vector<double> firstTimes, double tolerance, int mostIntervals);

  bool isDone() const override { return isDone_; }
  double nextTime() const override;
  void take(vtkDataObject* data) override;
  double progress() const override { return progress_; }
  double relativeError() const override;
  double relativeNoise() const override;
  std::string shortfall() const override;

private:
  using Node = std::shared_ptr<const ExposureNode>;
  struct Merge;
  /// Where the sums over a span of time go: the first or the second half of a longer span; null: it is all.
  struct Place
  {
    std::shared_ptr<Merge> whole;
    bool isSecond = false;
  };
  /// Two halves become one.
  struct Merge
  {
    Place place;
    std::unique_ptr<ExposureSums> other; ///< of the half that came first
  };
  /// An interval whose middle is to be visited, or three times.
  struct Task
  {
    Node start, end;
    Place place;
  };
  struct Pair
  {
    Node start, middle, end;
    Place place;
  };

  void makePlaces(const Place& place, std::size_t count);
  void addPair(const Pair& pair);
  void settle(std::size_t id);
  void deliver(Place place, std::unique_ptr<ExposureSums> sums);
  /// Asks for the halves of the worst pair, or ends.
  void halveWorst();
  void finish();

  std::vector<double> firstTimes_;
  double tolerance_;
  int mostIntervals_;
  TimeHalving halving_;
  ExposureSums checks_; ///< of all that is taken, with weights of 0: whether it fits together
  std::vector<ExposureBlock> blocks_;
  std::vector<Place> firstPlaces_; ///< of pairs of first intervals
  std::vector<Node> recent_;       ///< of the first times, those of the pair that is not complete
  std::map<std::size_t, Pair> open_;
  std::size_t nextId_ = 0;
  std::deque<Task> tasks_;
  double firstExcess_ = 0; ///< TimeHalving::excess() when all first times are known
  double progress_ = 0;
  bool isDone_ = false;
};

}

#endif
