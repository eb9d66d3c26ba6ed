# SPDX-License-Identifier: BSD-3-Clause
"""Opens the result of an example in ParaView as in its picture: rooms cut open, lamps bright, a legend with its unit.

    paraview --script=FOLDER/ParaViewState.py          or in ParaView: File > Load State

LitRoom, MovingTeapot, CuringOven and Office put a copy of this file beside what they write, with a first line that says in
which FOLDER: ParaView does not tell a script where it is. A folder that was moved needs another first line.
"""
import os

import numpy as np
from paraview import servermanager
from paraview.simple import (CellSize, Delete, ExtractBlock, GetActiveViewOrCreate, GetColorTransferFunction,
                             GetScalarBar, OpenDataFile, Render, Show)
from vtkmodules.numpy_interface.dataset_adapter import NoneArray, WrapDataObject
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

IRON = (0, 0, 0.02), (0.34, 0.06, 0.43), (0.74, 0.22, 0.33), (0.98, 0.56, 0.04), (0.99, 1, 0.65)
VIOLET = (0.01, 0.01, 0.04), (0.15, 0.07, 0.35), (0.38, 0.16, 0.62), (0.62, 0.36, 0.86), (0.83, 0.68, 0.97), (1, 1, 1)
# By the file: the cell array, its title and colours, which end where `share` of the area has less; what is cut open
# and which of its sides is left out; what shines; the camera, where it looks to and its angle (m, degrees).
EXAMPLES = {
    "irradiance.vtm": {
        "array": "Irradiance", "title": "Irradiance (W/m2)", "colours": IRON, "share": 0.999, "open": "room",
        "culled": "Cull Frontface", "lamps": ["lamp"], "camera": ((0, -8.5, 1.5), (0, 0, 1.5), 34)},
    "MovingTeapot.pvd": {
        "array": "Irradiance", "title": "Irradiance (W/m2)", "colours": IRON, "share": 0.99, "open": "room",
        "culled": "Cull Backface", "lamps": ["lamp"], "camera": ((0, -6, 1.2), (0, 0, 1.2), 36)},
    "CuringOven.vtm": {
        "array": "RadiantExposure", "title": "Dose of the oven (J/m2)", "colours": VIOLET, "share": 0.99,
        "open": "tunnel", "culled": "Cull Backface", "lamps": ["lamps", "reflectors"],
        "camera": ((0.5, -4.4, 1.6), (0, 0, 0.25), 46)},
    "Office.pvd": {
        "array": "Illuminance", "title": "Illuminance (lx)", "colours": IRON, "share": 0.99, "open": "room",
        "culled": "Cull Backface", "lamps": ["panels", "pendants"], "camera": ((6, -9.5, 11), (6, 3.7, 0.6), 34)},
}


def find_result():
    folder = globals().get("FOLDER", ".")
    for name, example in EXAMPLES.items():
        if os.path.exists(os.path.join(folder, name)):
            return os.path.join(folder, name), example
    raise RuntimeError(f"{folder}, the FOLDER in the first line of ParaViewState.py, has no {' or '.join(EXAMPLES)}")


def block_names(data):
    """Of all polydata in it, static ones first."""
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        if block and block.IsA("vtkMultiBlockDataSet"):
            yield from block_names(block)
        elif block:
            yield data.GetMetaData(i).Get(vtkCompositeDataSet.NAME())


def percentile(source, array, share):
    """What `share` of the area has at most."""
    sizes = CellSize(Input=source, ComputeVertexCount=0, ComputeLength=0, ComputeVolume=0)
    cells = WrapDataObject(servermanager.Fetch(sizes)).CellData
    Delete(sizes)
    pairs = [(v, a) for v, a in zip(cells[array].Arrays, cells["Area"].Arrays) if v is not NoneArray]
    values, areas = (np.concatenate(column) for column in zip(*pairs))
    order = np.argsort(values)
    covered = np.cumsum(areas[order])
    return float(values[order][np.searchsorted(covered, share * covered[-1])])


def blocks_of(source, names):
    return ExtractBlock(Input=source, Assembly="Hierarchy", Selectors=[f"//{name}" for name in names])


def show_blocks(source, names):
    """Its blocks of these names, in their own colours: light is no subject of ParaView's lamps."""
    display = Show(blocks_of(source, names))
    display.Representation = "Surface"
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0
    return display


def dose_colours(least, most):
    """Blue where it is under-cured, red where it is over-cured; a jump at each limit."""
    jump = 1e-6 * most
    return [0, 0.05, 0.08, 0.35, least - jump, 0.45, 0.70, 1.00, least, 0.05, 0.40, 0.25,
            (least + most) / 2, 0.45, 0.72, 0.25, most, 0.98, 0.95, 0.55, most + jump, 1.00, 0.50, 0.15,
            1.5 * most, 0.60, 0.00, 0.08]


def show_array(display, array, points, separate=False):
    display.ColorArrayName = ("CELLS", array)
    display.UseSeparateColorMap = separate
    colours = GetColorTransferFunction(array, display, separate=separate)
    colours.AutomaticRescaleRangeMode, colours.ColorSpace = "Never", "RGB"
    colours.RGBPoints = points
    display.LookupTable = colours
    return colours


def show_legend(view, colours, title, left):
    legend = GetScalarBar(colours, view)
    legend.Title, legend.ComponentTitle = title, ""
    legend.WindowLocation = "Any Location"
    legend.Position, legend.ScalarBarLength = (left, 0.2), 0.6
    legend.TitleFontSize = legend.LabelFontSize = 14
    legend.AutomaticLabelFormat, legend.LabelFormat, legend.RangeLabelFormat = 0, "%-.3g", "%-.3g"
    legend.Visibility = 1


def main():
    file, example = find_result()
    source = OpenDataFile(file)
    source.UpdatePipeline()
    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode, view.Background = "Single Color", (0.15, 0.15, 0.17)
    data = servermanager.Fetch(source)
    still, moving = (list(block_names(data.GetBlock(i))) for i in range(2))
    others = [name for name in still if name not in (example["open"], *example["lamps"])]
    limits = data.GetFieldData().GetArray("DoseLimits")
    if not limits:
        others += moving

    array, steps = example["array"], example["colours"]
    most = percentile(blocks_of(source, [example["open"], *others]), array, example["share"])
    points = [x for i, colour in enumerate(steps) for x in (most * i / (len(steps) - 1), *colour)]
    opened = show_blocks(source, [example["open"]])
    opened.BackfaceRepresentation = example["culled"]
    colours = show_array(opened, array, points)
    show_array(show_blocks(source, others), array, points)
    if limits:
        doses = dose_colours(limits.GetValue(0), limits.GetValue(1))
        parts = show_array(show_blocks(source, moving), array, doses, separate=True)
        show_legend(view, parts, "Dose of the parts (J/m2)", 0.03)
    lamps = show_blocks(source, example["lamps"])
    lamps.ColorArrayName = (None, "")
    lamps.AmbientColor = lamps.DiffuseColor = (1, 1, 1)
    show_legend(view, colours, example["title"], 0.88)

    Render(view)  # the first one moves the camera
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewAngle = example["camera"]
    view.CameraViewUp = (0, 0, 1)
    Render(view)


main()
