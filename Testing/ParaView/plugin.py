# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in this process, and what the tests share. FOLDER holds the files of ReferenceScene."""
import os

from paraview import servermanager
from paraview.simple import (
    ColorBy, GetActiveViewOrCreate, LoadDistributedPlugin, Show, XMLMultiBlockDataReader, XMLPolyDataReader)
import paraview.simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

FOLDER = os.environ["REFERENCE_SCENE"]
OUTPUT = os.environ["OUTPUT"]
TIMES = ["0", "0.375", "1", "1.7", "2"]
STEPS = [i / 50 for i in range(50)] + [1 + i / 50 for i in range(51)]  # keys 0, 1, 2; a hundred intervals

# Found by PV_PLUGIN_PATH.
LoadDistributedPlugin("IrradiancePlugin", remote=False, ns=vars(paraview.simple))


def make_pose(**properties):
    """The moving part, with its key frames from the file."""
    values = {"Input": XMLPolyDataReader(FileName=[f"{FOLDER}/part.vtp"]), "FileName": f"{FOLDER}/poses.csv"}
    return paraview.simple.KeyFramedPose(**{**values, **properties})


def make_scene(**properties):
    """The Irradiance filter of ReferenceScene."""
    room = XMLPolyDataReader(FileName=[f"{FOLDER}/room.vtp"])
    values = {"Static": [room], "Dynamic": [make_pose()], "NumberOfWalks": 100000, "ComputeStandardError": 1}
    return paraview.simple.Irradiance(**{**values, **properties})


def show(source, size):
    """A view of `size` x `size` pixels into the room of ReferenceScene, in the colours of the irradiance."""
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [size, size]
    view.OrientationAxesVisibility = 0
    display = Show(source, view)
    ColorBy(display, ("CELLS", "Irradiance"))
    display.SetScalarBarVisibility(view, False)
    display.LookupTable.RescaleTransferFunction(0, 12)
    display.BackfaceRepresentation = "Cull Frontface"
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1.95, 1.6], [0, 0, 1], [0, 0, 1]
    return view


def figure(source, name):
    """Of the last update, from the field data of the output."""
    return servermanager.Fetch(source).GetFieldData().GetArray(name).GetValue(0)


def leaves(data):
    """The polydata of a composite data set, in order."""
    iterator = data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def bits(data):
    """Points, cell arrays and field data of a composite data set as bytes, by name, without times (TimeValue:
    the time of files)."""
    found = {}
    for i in range(data.GetFieldData().GetNumberOfArrays()):
        array = data.GetFieldData().GetArray(i)
        if array is None:  # of texts
            continue
        if not array.GetName().endswith(("Seconds", "TimeValue")):
            found[array.GetName()] = bytes(memoryview(array))
    for number, leaf in enumerate(leaves(data)):
        found[f"{number} points"] = bytes(memoryview(leaf.GetPoints().GetData()))
        for i in range(leaf.GetCellData().GetNumberOfArrays()):
            array = leaf.GetCellData().GetArray(i)
            found[f"{number} {array.GetName()}"] = bytes(memoryview(array))
    return found


def fetch(source, time=0.0):
    """The output of a source at a time."""
    source.SMProxy.UpdatePipeline(time)  # paraview.simple's own takes 0 for no time at all
    return servermanager.Fetch(source)


def messages_of(action):
    """What the user reads in the log of errors and warnings while something is done."""
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    try:
        action()
    finally:
        vtkOutputWindow.SetInstance(before)
    return window.GetOutput()
