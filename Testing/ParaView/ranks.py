# SPDX-License-Identifier: BSD-3-Clause
"""What several processes make of a scene together. For pvbatch; see TestRanks.py.

    pvbatch ranks.py FOLDER     prints results, and what each process has of them; leaves whole.png and pieces.png
"""
import hashlib
import sys

from paraview.simple import (
    ExtractSurface, GetDisplayProperties, Hide, IntegrateVariables, ProgrammableFilter, RedistributeDataSet,
    SaveScreenshot, Sphere, XMLPolyDataReader)

import plugin

# On each process: asks for all of the input, as an output has field data only then; tells what the process has.
ASK_FOR_ALL = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
request = self.GetInputInformation(0, 0)
request.Set(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER(), 0)
request.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES(), 1)
"""
TELL = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
data = self.GetInputDataObject(0, 0)
history = data.GetFieldData().GetArray("HistoryBytes").GetValue(0)
print(f"SHARE {name} {{rank}} {{history}} {{data.GetNumberOfCells()}}", flush=True)
"""


def look_at(name, source):
    """Takes a picture."""
    view = plugin.show(source, 200)
    # Three processes of ParaView 5.13 that cull fronts draw another box than one, of the same cells.
    GetDisplayProperties(source, view).BackfaceRepresentation = "Follow Frontface"
    view.ViewTime = 1
    SaveScreenshot(f"{sys.argv[1]}/{name}.png", view, ImageResolution=[200, 200])
    Hide(source, view)


def tell_result(name, result, attributes, array):
    """Sums over the cells or points of all processes. The order depends on their number, and so do the points' type:
    Redistribute DataSet makes doubles unless it is alone."""
    result.SMProxy.UpdatePipeline(1.0)
    total = IntegrateVariables(Input=result)
    total.SMProxy.UpdatePipeline(1.0)
    print("RESULT", name, result.GetDataInformation().GetNumberOfCells(),
          [f"{value:.9g}" for value in getattr(total, attributes)[array].GetRange()])


def tell_cells(name, source):
    """The irradiance of all cells, bit for bit, whoever has them."""
    cells = sorted(leaf.GetCellData().GetArray("Irradiance").GetTuple(i)
                   for leaf in plugin.leaves(plugin.fetch(source, 1.0)) for i in range(leaf.GetNumberOfCells()))
    print("RESULT", name, "cells", len(cells), hashlib.sha256(repr(cells).encode()).hexdigest())


def tell_walks(name, source):
    walks = plugin.paraview.simple.PhotonWalks(Input=source, NumberOfWalks=20)
    walks.UpdatePipeline(1.0)
    print("RESULT", name, "walks", walks.GetDataInformation().GetNumberOfCells())


def tell_shares(name, source, **scripts):
    shares = ProgrammableFilter(Input=source, OutputDataSetType="vtkPolyData", Script=TELL.format(name=name), **scripts)
    shares.SMProxy.UpdatePipeline(1.0)


def tell_whole():
    """All inputs are whole on each process. Shot: what is gathered is kept on all, beside the walks that they share."""
    source = plugin.make_scene(Method="Spread Walks")
    tell_result("whole irradiance", source, "CellData", "Irradiance")
    tell_cells("whole", source)
    tell_shares("whole", source, RequestUpdateExtentScript=ASK_FOR_ALL)
    look_at("whole", source)
    tell_what_looks("whole", source)
    tell_walks("whole", source)
    dose = plugin.paraview.simple.RadiantExposure(Input=source)
    tell_result("whole dose", dose, "CellData", "RadiantExposure")


def tell_what_looks(name, source):
    """Radiance and sensors, for which each process computes all photons, as for walks to look at."""
    radiance = plugin.paraview.simple.OutgoingRadiance(Input=source, EyePosition=[0, -1.9, 1.5])
    tell_result(f"{name} radiance", radiance, "CellData", "Radiance")
    probe = plugin.paraview.simple.IrradianceProbe(
        Sensors=Sphere(Radius=1, Center=[0, 0, 1]), Source=source, Estimate="Nearest",
        MaximumDistance=100)
    tell_result(f"{name} sensors", probe, "PointData", "SearchRadius")


def in_pieces(source):
    return ExtractSurface(Input=RedistributeDataSet(Input=source))


def tell_pieces():
    """Each process has a piece of each input."""
    room = in_pieces(XMLPolyDataReader(FileName=[f"{plugin.FOLDER}/room.vtp"]))
    part = plugin.make_pose(Input=in_pieces(plugin.make_pose().Input))
    source = plugin.make_scene(
        Static=[room], Dynamic=[part], Method="Spread Walks", DistributedInput=1)
    tell_result("pieces irradiance", source, "CellData", "Irradiance")
    tell_cells("pieces", source)
    tell_shares("pieces", source)
    look_at("pieces", source)
    tell_what_looks("pieces", source)
    tell_walks("pieces", source)


tell_whole()
tell_pieces()
