# SPDX-License-Identifier: BSD-3-Clause
"""Small scenes with known power."""
import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

import vtkIrradiance


def make_lamp(exitance):
    """A square of 1 m2 around the origin that shines upwards; `exitance` (NumPy, one value) is kept by reference."""
    plane = vtkPlaneSource()
    plane.Update()
    WrapDataObject(plane.GetOutput()).CellData.append(exitance, "RadiantExitance")
    return plane.GetOutput()


def make_filter(exitance=100.0, walks=20000):
    """A lamp and, above it, a ball that a transform moves."""
    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.SetNumberOfWalks(walks)
    irradiance.AddInputDataObject(0, make_lamp(np.array([exitance])))
    ball = vtkSphereSource()
    irradiance.AddInputConnection(1, ball.GetOutputPort())
    pose = vtkTransform()
    pose.Translate(0, 0, 1)
    irradiance.SetDynamicTransform(0, pose)
    return irradiance


def field(irradiance, name):
    """A value of the field data of the output."""
    return irradiance.GetOutput().GetFieldData().GetArray(name).GetTuple1(0)


def irradiances(irradiance):
    """The irradiance of each input, static ones first: a list of NumPy arrays."""
    return WrapDataObject(irradiance.GetOutput()).CellData["Irradiance"].Arrays


def output_bits(irradiance):
    """All the light of the output, to compare."""
    return [array.tobytes() for array in irradiances(irradiance)]


def address(array):
    """Where a VTK array has its values."""
    return vtk_to_numpy(array).__array_interface__["data"][0]
