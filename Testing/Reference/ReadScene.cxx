// SPDX-License-Identifier: BSD-3-Clause
#include "ReadScene.h"

#include "Input/InputConnection.h"
#include "Input/SceneReader.h"

#include <vtkIrradianceFilter.h>
#include <vtkPolyData.h>

namespace pathtracedroom
{

irradiance::SceneObjects ReadScene(vtkIrradianceFilter* filter)
{
  std::vector<irradiance::InputConnection> connections[2];
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      filter->GetInputAlgorithm(port, i)->Update();
      vtkDataObject* data = filter->GetInputDataObject(port, i);
      connections[port].push_back(port == 0
          ? irradiance::staticConnection(filter, i, data)
          : irradiance::dynamicConnection(
              filter, i, data, filter->GetDynamicTransform(i), filter->GetPoseArrayName()));
    }
  }
  irradiance::SceneReader reader;
  reader.read(connections[0], connections[1], filter->GetDefaultDiffuseReflectance(), {});
  return reader.objects();
}

}
