# SPDX-License-Identifier: BSD-3-Clause
"""The whole of vtkIrradiance in ten minutes: a room with a lamp, and a ball that moves through it.

Prints the light on the room, and leaves in the folder LitRoom-output irradiance.vtm, ParaViewState.py, which
opens it in ParaView, and the picture irradiance.png. It does what LitRoom.cxx does, with the same numbers to the
last bit.
"""
import os
import sys
from pathlib import Path

import numpy as np
import vtkmodules.vtkRenderingFreeType  # for the text of the legend
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource, vtkTessellatedBoxSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2

import vtkIrradiance


def set_name(mesh, name):
    """What the block of a mesh is called in the output; without a name it is "Static 0" or the like."""
    array = vtkStringArray()
    array.SetName("Name")
    array.InsertNextValue(name)
    mesh.GetFieldData().AddArray(array)


def make_room():
    """4 x 4 x 3 m, cut into cells, because every cell gets one value.

    Cells have two sides and we look at the inner ones. Without an array "DiffuseReflectance" they reflect
    half the light.
    """
    room = vtkTessellatedBoxSource()
    room.SetBounds(-2, 2, -2, 2, 0, 3)
    room.SetLevel(30)
    room.QuadsOn()
    room.Update()
    set_name(room.GetOutput(), "room")
    return room


def make_lamp():
    """Two metres square, below the ceiling.

    Any cell with a "RadiantExitance" shines, from its front: the side from which its points run
    counter-clockwise. VTK keeps the NumPy array as it is, without a copy.
    """
    plane = vtkPlaneSource()
    plane.SetOrigin(-1, -1, 2.9)
    plane.SetPoint1(-1, 1, 2.9)
    plane.SetPoint2(1, -1, 2.9)
    plane.Update()
    exitance = np.array([100.0])  # W/m2, one value for each cell
    WrapDataObject(plane.GetOutput()).CellData.append(exitance, "RadiantExitance")
    set_name(plane.GetOutput(), "lamp")
    return plane.GetOutput()


def most_of(output):
    """98 % of all cells receive at most this, W/m2. The few brightest shall not darken the picture."""
    return np.percentile(np.concatenate(output.CellData["Irradiance"].Arrays), 98)


def make_actor(mesh, colours, is_room, is_lamp):
    """In the colours of the array; VTK's own lights are off."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Irradiance")
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    mapper.SetScalarVisibility(not is_lamp)  # the lamp is white
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetFrontfaceCulling(is_room)  # its outside
    return actor


def make_legend(colours):
    legend = vtkScalarBarActor()
    legend.SetLookupTable(colours)
    legend.SetTitle("Irradiance (W/m2)")
    legend.SetLabelFormat("  %-.3g")
    legend.SetMaximumNumberOfColors(256)
    legend.UnconstrainedFontSizeOn()
    legend.GetTitleTextProperty().SetFontSize(14)
    legend.SetVerticalTitleSeparation(12)
    legend.SetPosition(0.865, 0.1)
    legend.SetWidth(0.12)
    legend.SetHeight(0.8)
    return legend


def write_picture(output, name):
    """Looks into the room through its front wall."""
    colours = vtkColorTransferFunction()  # as glowing iron
    iron = ((0, 0, 0.02), (0.34, 0.06, 0.43), (0.74, 0.22, 0.33), (0.98, 0.56, 0.04), (0.99, 1, 0.65))
    for i, colour in enumerate(iron):
        colours.AddRGBPoint(most_of(output) * i / 4, *colour)
    renderer = vtkRenderer()
    renderer.SetBackground(0.15, 0.15, 0.17)
    for i, mesh in enumerate(output):
        renderer.AddActor(make_actor(mesh.VTKObject, colours, is_room=i == 0, is_lamp=i == 1))
    renderer.AddViewProp(make_legend(colours))
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0, 0, 1)
    camera.SetPosition(0, -8.5, 1.5)
    camera.SetFocalPoint(0, 0, 1.5)
    camera.SetViewAngle(28)
    camera.SetWindowCenter(0.16, 0)  # leaves a margin to the legend
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(1000, 680)
    window.AddRenderer(renderer)
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    picture = vtkPNGWriter()
    picture.SetInputConnection(grabber.GetOutputPort())
    picture.SetFileName(name)
    picture.Write()


def main():
    if len(sys.argv) > 1:
        print("LitRoom.py: the light in a room through which a ball moves. It has no options.\n\n"
              "Results: ./LitRoom-output: irradiance.vtm, ParaViewState.py, irradiance.png")
        return
    room = make_room()
    lamp = make_lamp()
    # The ball stays the same in its own coordinates; a transform places it in the world.
    ball = vtkSphereSource()
    ball.SetThetaResolution(32)
    ball.SetPhiResolution(32)
    ball.Update()
    set_name(ball.GetOutput(), "ball")
    world_from_ball = vtkTransform()
    world_from_ball.Translate(-1, 0, 0.7)

    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.AddInputConnection(0, room.GetOutputPort())  # what stays: walls, lamps
    irradiance.AddInputDataObject(0, lamp)
    irradiance.AddInputConnection(1, ball.GetOutputPort())  # what moves, in model coordinates
    irradiance.SetDynamicTransform(0, world_from_ball)
    irradiance.SetMethodToGatheredEverywhere()  # not only small cells look for indirect light: no grain

    # The first update shoots a million photon walks. The others shoot again only what the ball has changed;
    # their result is the same, bit for bit, as if all were shot again.
    for _ in range(8):
        world_from_ball.Translate(0.1, 0, 0)
        vtkIrradiance.update(irradiance)  # as Update(), but errors are exceptions and Ctrl-C works

        # "Static" and "Dynamic" hold a polydata for each connection; here are the arrays of all of them, one
        # after the other, which NumPy shares with VTK. Field data of the whole say how it went.
        output = WrapDataObject(irradiance.GetOutput())
        lit = output.CellData["Irradiance"].Arrays[0]  # W/m2 on the cells of the room
        report = irradiance.GetOutput().GetFieldData()
        print(f"Irradiance {lit.min():g} to {lit.max():g} W/m2; "
              f"{report.GetArray('NumberOfRepairedSegments').GetTuple1(0):g} of "
              f"{report.GetArray('NumberOfSegments').GetTuple1(0):g} segments shot again")

    # For ParaView: the last frame with all its arrays, and how to look at it.
    folder = Path("LitRoom-output")
    folder.mkdir(exist_ok=True)
    (folder / "irradiance.png").unlink(missing_ok=True)  # of an earlier run
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputConnection(irradiance.GetOutputPort())
    writer.SetFileName(str(folder / "irradiance.vtm"))
    writer.SetDataModeToBinary()  # Debian's ParaView cannot read the default, appended data
    writer.Write()

    state = (Path(__file__).parent.parent / "ParaViewState.py").read_text(encoding="utf-8")
    (folder / "ParaViewState.py").write_text(f'FOLDER = "{folder.absolute()}"\n{state}', encoding="utf-8")

    # Where VTK draws by X it ends the program if there is no display.
    if vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY"):
        print("No picture: DISPLAY is not set, and VTK needs an X display (xvfb-run is one).", file=sys.stderr)
        return
    write_picture(output, str(folder / "irradiance.png"))


if __name__ == "__main__":
    main()
