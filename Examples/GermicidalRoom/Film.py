# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the room in false colours on a scale of decades, and a movie of them."""
import numpy as np
import vtkmodules.vtkRenderingFreeType  # for the text of the legend
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor,
                                         vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2

from vtkIrradiance import add_cell_array

COLOURS = (0.01, 0.01, 0.04), (0.15, 0.07, 0.35), (0.38, 0.16, 0.62), (0.62, 0.36, 0.86), (0.83, 0.68, 0.97), (1, 1, 1)


class Film:
    """Looks into the room from above the door; ceiling and near wall are left out."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "pictures").mkdir(exist_ok=True)
        self.colours = vtkLookupTable()
        self.colours.SetNumberOfTableValues(256)
        for i, place in enumerate(np.linspace(0, len(COLOURS) - 1, 256)):
            self.colours.SetTableValue(i, *(np.interp(place, range(len(COLOURS)), part) for part in zip(*COLOURS)), 1)
        self.colours.SetScaleToLog10()
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.15, 0.15, 0.17)
        camera = self.renderer.GetActiveCamera()
        camera.SetViewUp(0, 0, 1)
        camera.SetPosition(4.6, -5.9, 6)
        camera.SetFocalPoint(3, 1.9, 0.8)
        camera.SetViewAngle(34)
        camera.SetWindowCenter(0.13, 0)  # leaves a margin to the legend
        self.window = vtkRenderWindow()
        self.window.OffScreenRenderingOn()
        self.window.SetSize(1200, 680)
        self.window.AddRenderer(self.renderer)
        self.movie = vtkOggTheoraWriter()
        self.movie.SetFileName(str(folder / "GermicidalRoom.ogv"))
        self.movie.SetRate(4)

    def add(self, output, name, caption):
        """A frame of the movie: irradiance."""
        grabber = self.draw(output, "IrradianceFront", "W/m2", (1e-3, 1e2), caption, f"pictures/{name}.png")
        if not self.movie.GetInput():
            self.movie.SetInputData(grabber.GetOutput())
            self.movie.Start()
        self.movie.SetInputData(grabber.GetOutput())
        self.movie.Write()

    def end(self):
        self.movie.End()

    def draw(self, output, array, title, span, caption, name):
        self.renderer.RemoveAllViewProps()
        self.colours.SetTableRange(span)
        for mesh in output:
            self.renderer.AddActor(self.actor_of(mesh.VTKObject, array, mesh.FieldData["Name"].GetValue(0)))
        self.renderer.AddViewProp(self.legend(title, round(np.log10(span[1] / span[0]))))
        text = vtkTextActor()
        text.SetInput(caption)
        text.SetPosition(20, 20)
        text.GetTextProperty().SetFontSize(20)
        self.renderer.AddViewProp(text)
        self.renderer.ResetCameraClippingRange()
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.window)
        grabber.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(grabber.GetOutputPort())
        writer.SetFileName(str(self.folder / name))
        writer.SetCompressionLevel(9)
        writer.Write()
        return grabber

    def actor_of(self, mesh, array, name):
        """VTK's own lights are off; what emits is white."""
        shown = WrapDataObject(mesh.NewInstance())
        shown.ShallowCopy(mesh)
        values = np.array(shown.CellData[array])
        if "RadiantExitance" in shown.CellData.keys():
            values[np.asarray(shown.CellData["RadiantExitance"]) > 0] = self.colours.GetTableRange()[1]
        add_cell_array(shown.VTKObject, "Shown", values)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(shown.VTKObject)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("Shown")
        mapper.SetLookupTable(self.colours)
        mapper.UseLookupTableScalarRangeOn()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetBackfaceCulling(name == "room")  # its outside
        actor.GetProperty().SetOpacity(0.5 if name == "curtain" else 1)
        return actor

    def legend(self, title, decades):
        legend = vtkScalarBarActor()
        legend.SetLookupTable(self.colours)
        legend.SetTitle(title)
        legend.SetLabelFormat("  %-.4g")
        legend.SetNumberOfLabels(decades + 1)
        legend.SetMaximumNumberOfColors(256)
        legend.UnconstrainedFontSizeOn()
        for text in (legend.GetTitleTextProperty(), legend.GetLabelTextProperty()):
            text.SetFontSize(18)
            text.ItalicOff()
            text.ShadowOff()
        legend.SetVerticalTitleSeparation(12)
        legend.SetPosition(0.87, 0.1)
        legend.SetWidth(0.12)
        legend.SetHeight(0.8)
        return legend
