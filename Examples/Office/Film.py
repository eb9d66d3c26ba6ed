# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the office in false colours, and a movie of them."""
import vtkmodules.vtkRenderingFreeType  # for the text of the legend
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2


class Film:
    """Looks into the office from above; ceiling and near walls are left out."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "pictures").mkdir()
        self.colours = vtkColorTransferFunction()
        for lux, *colour in ((0, 0, 0, 0.1), (100, 0.2, 0.1, 0.6), (300, 0, 0.55, 0.75), (500, 0.15, 0.75, 0.3),
                             (650, 0.95, 0.85, 0.1), (800, 1, 0.3, 0)):
            self.colours.AddRGBPoint(lux, *colour)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.15, 0.15, 0.17)
        camera = self.renderer.GetActiveCamera()
        camera.SetViewUp(0, 0, 1)
        camera.SetPosition(6, -9.5, 11)
        camera.SetFocalPoint(6, 3.7, 0.6)
        camera.SetViewAngle(34)
        camera.SetWindowCenter(0.1, 0)  # leaves a margin to the legend
        self.window = vtkRenderWindow()
        self.window.OffScreenRenderingOn()
        self.window.SetSize(1200, 640)
        self.window.AddRenderer(self.renderer)
        self.movie = vtkOggTheoraWriter()
        self.movie.SetFileName(str(folder / "Office.ogv"))
        self.movie.SetRate(4)

    def add(self, output, name, caption):
        self.renderer.RemoveAllViewProps()
        for i, mesh in enumerate(output):
            self.renderer.AddActor(self.actor_of(mesh.VTKObject, is_room=i == 0, is_lamp=i in (1, 2)))
        self.renderer.AddViewProp(self.legend())
        text = vtkTextActor()
        text.SetInput(caption)
        text.SetPosition(20, 20)
        text.GetTextProperty().SetFontSize(18)
        self.renderer.AddViewProp(text)
        self.renderer.ResetCameraClippingRange()
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.window)
        grabber.Update()
        self.write_picture(grabber, self.folder / "pictures" / f"{name}.png")
        self.write_picture(grabber, self.folder / "Office.png")  # the last one stays
        if not self.movie.GetInput():
            self.movie.SetInputData(grabber.GetOutput())
            self.movie.Start()
        self.movie.SetInputData(grabber.GetOutput())
        self.movie.Write()

    def end(self):
        self.movie.End()

    def actor_of(self, mesh, is_room, is_lamp):
        """VTK's own lights are off; lamps are white."""
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("Illuminance")
        mapper.SetLookupTable(self.colours)
        mapper.UseLookupTableScalarRangeOn()
        mapper.SetScalarVisibility(not is_lamp)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetBackfaceCulling(is_room)  # its outside
        if is_lamp:
            actor.GetProperty().SetRepresentationToWireframe()
        return actor

    def legend(self):
        legend = vtkScalarBarActor()
        legend.SetLookupTable(self.colours)
        legend.SetTitle("Illuminance (lx)")
        legend.SetLabelFormat("  %.0f")
        legend.SetMaximumNumberOfColors(256)
        legend.UnconstrainedFontSizeOn()
        legend.GetTitleTextProperty().SetFontSize(14)
        legend.SetVerticalTitleSeparation(12)
        legend.SetPosition(0.88, 0.1)
        legend.SetWidth(0.1)
        legend.SetHeight(0.8)
        return legend

    @staticmethod
    def write_picture(grabber, path):
        picture = vtkPNGWriter()
        picture.SetInputConnection(grabber.GetOutputPort())
        picture.SetFileName(str(path))
        picture.Write()
