// SPDX-License-Identifier: BSD-3-Clause
#include "ReadScene.h"

#include "Input/SceneReader.h"

#include <vtkIrradianceFilter.h>
#include <vtkPolyData.h>

namespace pathtracedroom
{

irradiance::SceneObjects ReadScene(vtkIrradianceFilter* filter)
{
  irradiance::SceneInputs inputs;
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      filter->GetInputAlgorithm(port, i)->Update();
      vtkDataObject* data = filter->GetInputDataObject(port, i);
      (port == 0 ? inputs.statics : inputs.dynamics)
        .push_back(port == 0 ? irradiance::staticConnection(filter, i, data)
                             : irradiance::dynamicConnection(filter, i, data,
                                 filter->GetDynamicTransform(i), filter->GetPoseArrayName()));
    }
  }
  irradiance::SceneReader reader;
  reader.read(inputs, filter->GetDefaultDiffuseReflectance(), {});
  return reader.objects();
}

}
