// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RanksPipeline_h
#define irradiance_RanksPipeline_h

#include "vtkCompositeDataPipeline.h"

#include <functional>

namespace irradiance
{

/// The executive of a filter that works with other processes. If something upstream fails, VTK does
/// not call the filter; then the others would wait for it.
class RanksPipeline : public vtkCompositeDataPipeline
{
public:
  vtkTypeMacro(RanksPipeline, vtkCompositeDataPipeline);
  static RanksPipeline* New();

  std::function<void()> upstreamFailed; ///< is called in place of RequestData()

protected:
  int ForwardUpstream(vtkInformation* request) override;
  using vtkCompositeDataPipeline::ForwardUpstream;
};

}

#endif
