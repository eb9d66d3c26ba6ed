// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonSource_h
#define irradiance_PhotonSource_h

#include "IrradianceEngine.h"

#include <functional>
#include <memory>

class vtkDataObject;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace irradiance
{

/**
 * The engine behind an output of vtkIrradianceFilter. The output carries a counted reference to it,
 * which its shallow and deep copies share, so it lives as long as they do.
 */
class PhotonSource
{
public:
  /// Lets an output refer to the present state of an engine. It needs field data to hold on to.
  static void attach(vtkMultiBlockDataSet* output, std::shared_ptr<IrradianceEngine> engine);

  /// `what`: the input, as errors name it. Throws InputError if the data refers to no engine, if the
  /// engine has gone on since, or if it did not keep the photons.
  PhotonSource(vtkDataObject* data, const char* what);

  const std::shared_ptr<IrradianceEngine>& engine() const { return engine_; }

  /// Calls visit(polydata, object, number of its first cell) for all polydata of an output, in the
  /// order in which the engine numbers them. Throws InputError if that is not what the engine has.
  using Visit = std::function<void(vtkPolyData*, std::uint32_t object, std::size_t firstCell)>;
  void forEachPart(vtkMultiBlockDataSet* data, const Visit& visit) const;

private:
  void failUnlike() const;

  const char* what_;
  std::shared_ptr<IrradianceEngine> engine_;
};

}

#endif
