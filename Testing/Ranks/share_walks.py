# SPDX-License-Identifier: BSD-3-Clause
"""Under mpirun: filters share their walks over the processes, and bring what one filter alone brings.

    mpirun -n 2 python3 share_walks.py
"""
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

import vtkIrradiance


def values(irradiance):
    blocks = [irradiance.GetOutput().GetBlock(port).GetBlock(0) for port in (0, 1)]
    arrays = [block.GetCellData().GetArray("Irradiance") for block in blocks]
    return [array.GetValue(i) for array in arrays for i in range(array.GetNumberOfValues())]


controller = vtkIrradiance.use_mpi()
lamp, ball, pose = vtkPlaneSource(), vtkSphereSource(), vtkTransform()
lamp.Update()
vtkIrradiance.add_cell_array(lamp.GetOutput(), "RadiantExitance", [100.0])
together, alone = vtkIrradiance.vtkIrradianceFilter(), vtkIrradiance.vtkIrradianceFilter()
assert together.GetController() is controller
alone.SetController(None)
for irradiance in (together, alone):
    irradiance.SetNumberOfWalks(20000)
    irradiance.SetMethodToWalks()  # what is gathered is kept on each process
    irradiance.AddInputDataObject(0, lamp.GetOutput())
    irradiance.AddInputConnection(1, ball.GetOutputPort())
    irradiance.SetDynamicTransform(0, pose)
for _ in range(3):
    pose.Translate(0, 0, 0.4)
    vtkIrradiance.update(together)
    vtkIrradiance.update(alone)
    assert values(together) == values(alone) and max(values(alone)) > 0
share = together.GetFigure("HistoryBytes") / alone.GetFigure("HistoryBytes")
processes = controller.GetNumberOfProcesses()
assert abs(share * processes - 1) < 0.3, f"{share} of the walks on one of {processes} processes"
