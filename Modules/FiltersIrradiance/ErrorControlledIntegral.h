// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ErrorControlledIntegral_h
#define irradiance_ErrorControlledIntegral_h

#include "ExposureIntegral.h"
#include "ExposureTimes.h"

#include "vtkDoubleArray.h"

#include <string>
#include <vector>

namespace irradiance
{

/**
 * The trapezoidal rule over intervals that are halved until its error, as estimated, is small enough.
 *
 * The first intervals are equal. From the first to the last, each is tried with the time in its
 * middle. On every leaf, the sum over cells of area * |two halves - the whole| is its error. It is
 * accepted, in two halves, if all leaves allow that; else its left half is tried, then its right half.
 * On a leaf whose exposure sums up to D, half of the tolerated tolerance * D belongs to the intervals by
 * their lengths. The other half is a reserve, and what intervals leave of their share joins it. An
 * interval may take its share, or a quarter of all that is left up to its end, so that a jump of
 * the irradiance ends after some halvings. Documentation/Theory.md, 5.6.
 *
 * All decisions follow from the irradiance, so the times do too. No more than the times of the first
 * intervals and those between which is halved are held.
 */
class ErrorControlledIntegral : public ExposureIntegral
{
public:
  struct Config
  {
    TimeSpan span;
    int firstIntervals; ///< >= 1
    double tolerance;   ///< relative, > 0
    int mostIntervals;  ///< >= 2 * firstIntervals
  };

  explicit ErrorControlledIntegral(const Config& config);

  bool isDone() const override { return isDone_; }
  double nextTime() const override;
  void take(vtkDataObject* data) override;
  double progress() const override;
  double relativeError() const override;
  std::string shortfall() const override;

private:
  /// The irradiance of a leaf at a time.
  struct LeafNode
  {
    std::vector<vtkSmartPointer<vtkDoubleArray>> irradiances; ///< of its sides; none without cells
    double power = 0;                                         ///< W, of all cells, sides and bands
  };
  struct Node
  {
    double time = 0;
    vtkSmartPointer<vtkDataObject> data;
    std::vector<LeafNode> leaves;
  };
  struct Leaf
  {
    std::string name;
    std::vector<double> areas; ///< of its cells, m2; empty: there were none yet
    double energy = 0;         ///< J, as known so far
    double error = 0;          ///< J, of all that is accepted
  };

  LeafNode leafNodeOf(Leaf& leaf, vtkDataSet* data) const;
  void begin();
  void tryInterval(const Node& middle);
  /// J, summed up over the cells of a leaf: |two halves - the whole|.
  double difference(std::size_t leaf, const Node& middle) const;
  bool isAllowed(const std::vector<double>& errors) const;
  bool canHalve(const Node& middle) const;
  void accept(const Node& middle, const std::vector<double>& errors);
  /// The next time in order is known.
  void settle(const Node& node);

  Config config_;
  ExposureSums checks_; ///< of all that is taken, with weights of 0: whether it fits together
  std::vector<Leaf> leaves_;
  std::vector<double> firstTimes_;
  std::vector<Node> first_; ///< at these times, until all are known
  Node left_;               ///< where the interval that is tried begins
  std::vector<Node> right_; ///< where it ends, at the back; before that, ends of later intervals
  double before_ = 0;       ///< the time before settled_, or its own if that is the first
  Node settled_;            ///< the last in order; it is added when the next one is known
  bool isCapped_ = false, isDone_ = false;
};

}

#endif
