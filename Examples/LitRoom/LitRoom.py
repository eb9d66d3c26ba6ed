# SPDX-License-Identifier: BSD-3-Clause
"""The whole of vtkIrradiance in ten minutes: a room with a lamp, and a ball that moves through it.

Prints the light on the room, and leaves irradiance.vtm for ParaView and the picture irradiance.png. It does
what LitRoom.cxx does, with the same numbers to the last bit.
"""
import numpy as np
import vtkmodules.vtkRenderingFreeType  # for the text of the legend
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource, vtkTessellatedBoxSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingOpenGL2 import vtkCompositePolyDataMapper2

import vtkIrradiance


def make_room():
    """4 x 4 x 3 m, cut into cells, because every cell gets one value.

    Cells have two sides and we look at the inner ones. Without an array "DiffuseReflectance" they reflect
    half the light.
    """
    room = vtkTessellatedBoxSource()
    room.SetBounds(-2, 2, -2, 2, 0, 3)
    room.SetLevel(20)
    room.QuadsOn()
    return room


def make_lamp():
    """A square metre below the ceiling.

    Any cell with a "RadiantExitance" shines, from its front: the side from which its points run
    counter-clockwise. VTK keeps the NumPy array as it is, without a copy.
    """
    plane = vtkPlaneSource()
    plane.SetOrigin(-0.5, -0.5, 2.9)
    plane.SetPoint1(-0.5, 0.5, 2.9)
    plane.SetPoint2(0.5, -0.5, 2.9)
    plane.Update()
    exitance = np.array([100.0])  # W/m2, one value for each cell
    WrapDataObject(plane.GetOutput()).CellData.append(exitance, "RadiantExitance")
    return plane.GetOutput()


def write_picture(irradiance, name):
    """From inside the room, in the colours of the array; VTK's own lights are off."""
    colours = vtkLookupTable()  # black, red, yellow, white
    colours.SetHueRange(0, 0.17)
    colours.SetSaturationRange(1, 0.4)
    colours.SetValueRange(0, 1)
    colours.SetRampToLinear()
    colours.SetTableRange(0, 6)  # W/m2
    mapper = vtkCompositePolyDataMapper2()
    mapper.SetInputConnection(irradiance.GetOutputPort())
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Irradiance")
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    scene = vtkActor()
    scene.SetMapper(mapper)
    scene.GetProperty().LightingOff()
    legend = vtkScalarBarActor()
    legend.SetLookupTable(colours)
    legend.SetTitle("W/m2")

    renderer = vtkRenderer()
    renderer.AddActor(scene)
    renderer.AddViewProp(legend)
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0, 0, 1)
    camera.SetPosition(0, -1.95, 1.5)
    camera.SetFocalPoint(0, 0, 1.4)
    camera.SetViewAngle(75)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(960, 720)
    window.AddRenderer(renderer)
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    picture = vtkPNGWriter()
    picture.SetInputConnection(grabber.GetOutputPort())
    picture.SetFileName(name)
    picture.Write()


def main():
    room = make_room()
    lamp = make_lamp()
    # The ball stays the same in its own coordinates; a transform places it in the world.
    ball = vtkSphereSource()
    ball.SetThetaResolution(32)
    ball.SetPhiResolution(32)
    world_from_ball = vtkTransform()
    world_from_ball.Translate(-1, 0, 0.8)

    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.AddInputConnection(0, room.GetOutputPort())  # what stays: walls, lamps
    irradiance.AddInputDataObject(0, lamp)
    irradiance.AddInputConnection(1, ball.GetOutputPort())  # what moves, in model coordinates
    irradiance.SetDynamicTransform(0, world_from_ball)

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

    # For ParaView: the last frame with all its arrays.
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputConnection(irradiance.GetOutputPort())
    writer.SetFileName("irradiance.vtm")
    writer.SetDataModeToBinary()  # Debian's ParaView cannot read the default, appended data
    writer.Write()

    write_picture(irradiance, "irradiance.png")


if __name__ == "__main__":
    main()
