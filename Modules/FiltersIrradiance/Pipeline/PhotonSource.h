// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/PartCells.h"
#include "LightGroups.h"

#include <functional>
#include <memory>
#include <vector>

class vtkDataObject;
class vtkInformation;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace irradiance
{

/// The light groups behind an output of vtkIrradianceFilter. The output carries a counted reference
/// to it, which its shallow and deep copies share, so it lives as long as they do.
class PhotonSource
{
public:
  /// Lets an output refer to the present state of the groups. It needs field data to hold on to.
  /// `pieces`: of all polydata, in order.
  static void attach(vtkMultiBlockDataSet* output, std::shared_ptr<LightGroups> groups,
    std::vector<PieceCells> pieces);
  /// Whether `output` is asked for a piece without cells, of data that refer to no groups as they
  /// are such a piece, too. What could not be computed has no blocks: that is an error on all
  /// processes.
  static bool isEmptyPiece(vtkMultiBlockDataSet* data, vtkInformation* output);

  /// `what`: the input, as errors name it. `readsPhotons`: stored ones, else no more than sums.
  /// Throws InputError if the data refers to no groups, if these have gone on since, or if they
  /// did not keep what is needed.
  PhotonSource(vtkDataObject* data, const char* what, bool readsPhotons);

  const std::shared_ptr<LightGroups>& groups() const { return groups_; }
  int bands() const { return groups_->any().objects().staticObject.material->bands; }

  /// Calls visit(polydata, its cells) for all polydata of an output, in the order in which the
  /// engines number them. Throws InputError if that is not what these have.
  using Visit = std::function<void(vtkPolyData*, const PartCells&)>;
  void forEachPart(vtkMultiBlockDataSet* data, const Visit& visit) const;

private:
  const char* what_;
  std::shared_ptr<LightGroups> groups_;
  std::vector<PieceCells> pieces_;
};

}
