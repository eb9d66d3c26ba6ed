# SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs where nothing has moved, in a room of 24,000 cells, and what arrays cost.

    BenchmarkPython.py [ROUNDS [CALLS]]
"""
import sys
import time

from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource, vtkTessellatedBoxSource

import vtkIrradiance


def make_filter():
    room, lamp, ball = vtkTessellatedBoxSource(), vtkPlaneSource(), vtkSphereSource()
    room.SetBounds(-2, 2, -2, 2, 0, 3)
    room.SetLevel(63)
    room.QuadsOn()
    lamp.SetCenter(0, 0, 2.9)
    lamp.SetNormal(0, 0, -1)
    lamp.Update()
    WrapDataObject(lamp.GetOutput()).CellData.append(100.0, "RadiantExitance")
    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.AddInputConnection(0, room.GetOutputPort())
    irradiance.AddInputDataObject(0, lamp.GetOutput())
    irradiance.AddInputConnection(1, ball.GetOutputPort())
    pose = vtkTransform()
    pose.Translate(0, 0, 1)
    irradiance.SetDynamicTransform(0, pose)
    irradiance.SetNumberOfWalks(100000)
    return irradiance


def executed_anew(irradiance):
    irradiance.Modified()
    vtkIrradiance.update(irradiance)


def values(irradiance):
    return WrapDataObject(irradiance.GetOutput()).CellData["Irradiance"].Arrays


def main(rounds=9, calls=500):
    irradiance = make_filter()
    vtkIrradiance.update(irradiance)
    before = [array.tobytes() for array in values(irradiance)]
    jobs = (("Update()", irradiance.Update, 1, 0.5),
            ("vtkIrradiance.update()", lambda: vtkIrradiance.update(irradiance), 1, 0.5),
            ("Modified() and vtkIrradiance.update()", lambda: executed_anew(irradiance), "nan", "nan"),
            ("the irradiance of all cells as NumPy arrays", lambda: values(irradiance), "nan", "nan"))
    for _ in range(rounds):
        for name, job, bar, aim in jobs:
            start = time.perf_counter()
            for _ in range(calls):
                job()
            milliseconds = 1000 * (time.perf_counter() - start) / calls
            print(f'"Python","{name}","ms",{milliseconds:.4g},{bar},{aim}')
    if [array.tobytes() for array in values(irradiance)] != before:
        sys.exit("nothing has moved, and the irradiance is another")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
