// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "LightFollower.h"

#include <vtkLookupTable.h>

class vtkActor;
class vtkMultiBlockDataSet;
class vtkRenderer;

namespace interactiveroom
{

/**
 * The things of a room in the colours of their irradiance. Points and cells are handed over once: a
 * motion is a transform of the actor, and a step of the light changes colours alone.
 */
class SceneView
{
public:
  SceneView(const Room& room, LightFollower& light, vtkRenderer* renderer);

  /** The end of the colours for the irradiance, W/m2. */
  void SetBrightest(double brightest);

  /** Colours all cells: by the irradiance, or by its part that rests on stale walks. */
  void Show(vtkMultiBlockDataSet* scene, bool isStaleShown);

  /** What the colours mean now. */
  vtkLookupTable* GetColors() { return this->Colors; }

  vtkActor* GetActor(int movingThing) { return this->Actors[this->FirstMoving + movingThing]; }

private:
  vtkActor* Add(vtkPolyData* mesh, vtkRenderer* renderer);

  std::vector<vtkSmartPointer<vtkActor>> Actors; // in the order of the filter's output
  std::vector<vtkSmartPointer<vtkPolyData>> Shown;
  std::size_t FirstMoving = 0;
  vtkNew<vtkLookupTable> Colors;
  double Brightest = 1; // W/m2
};

}
