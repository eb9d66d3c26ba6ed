// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Data/LeafData.h"
#include "Execution/Execution.h"
#include "Exposure/ReplicateSums.h"
#include "Time/EnergySums.h"

#include "vtkType.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace irradiance
{

/// The input at a time.
struct TimedData
{
  double time;
  vtkSmartPointer<vtkDataObject> data;
};

/// The radiant exposure of all cells: a weighted sum of their irradiance at several times, added up
/// in the order in which they come. Times come in order.
class ExposureSums
{
public:
  /// One of the arrays that are summed up.
  struct Side
  {
    std::string suffix; ///< of its name: Front, Back, or none
    int bands;
    std::vector<double> exposure; ///< J/m2
    std::optional<ReplicateSums> replicates;
    std::vector<double> errorBound; ///< J/m2, if there are errors, but no replicates
    /// J/m2 that light groups bring, by name. One that is not there at a time brings nothing then.
    std::map<std::string, std::vector<double>> groups;
  };
  struct Leaf
  {
    std::string name;
    unsigned int flatIndex = 0;
    vtkSmartPointer<vtkDataSet> geometry; ///< of the last time with cells; null: never any
    double firstTime = 0, time = 0;       ///< with cells; the geometry is of the last
    std::vector<Side> sides;
  };

  /// Adds the irradiance of a time. Throws InputError if it is missing, or does not fit to the
  /// irradiance of other times; then the sums are of no use any more.
  void add(const TimedData& input, double weight);
  /// No more times are added; what only adding needs is released.
  void close();
  /// Lets small cells draw on about `photons` photons, on the average of their leaf, as it was at
  /// its last time with cells; see spreadExposure(). The last thing before write(). Leaves that are
  /// not spreadable stay as they are.
  void spread(double photons, Execution& execution);
  /// Appends the sums over later times of the same input, whose first time is the last one of
  /// these.
  void append(ExposureSums next);
  /// Whether there was a cell at any time.
  bool haveCells() const;
  /// `last`: the data of the last time; `output`: empty, of the same type.
  void write(vtkDataObject* last, vtkDataObject* output) const;
  /// Throws InputError if a leaf that can be spread has irradiance, but not two replicates of it.
  static void expectReplicates(vtkDataObject* data);

private:
  void checkStructure(const std::vector<LeafData>& leaves, double time);

  std::vector<Leaf> leaves_;
  double firstTime_ = 0;
  EnergySums energies_;
};

}
