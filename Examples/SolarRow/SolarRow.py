#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A day of a field of solar trackers with bifacial modules, which turn to the sun, under the sky of a clear day.

Every step of the day has the light on both sides of all modules, and on the ground between them; the day has sums.
Documentation/SolarRow.md says what comes out and how it was checked. x points east, y north, z up; metres.
"""
import argparse
import csv
import math
import os
import re
import sys
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import vtkmodules.vtkRenderingFreeType  # for the text of the legend
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2

import vtkIrradiance

DAY, LATITUDE, LONGITUDE, TIME_ZONE = datetime(2024, 6, 21), 39.742, -105.18, -7  # Golden, Colorado
MODULES, LENGTH, WIDTH, GAP = 12, 2.0, 1.0, 0.02  # of a tracker: its modules lie across its axis, one after another
AXIS_HEIGHT, MOST_TILT = 1.5, 60.0  # m, degrees
COLUMNS, ROW_SPACING, MARGIN = 10, 13.0, 5.0  # trackers side by side; north to south; ground around them
CELL = 0.5  # m, the edge of all cells
MODULE_REFLECTANCE = 0.05
BIFACIALITY = 0.7  # what a back makes of its light, relative to a front
SIDES = ("Front", "Back")
IRON = (0, 0, 0.02), (0.34, 0.06, 0.43), (0.74, 0.22, 0.33), (0.98, 0.56, 0.04), (0.99, 1, 0.65)


def clear_sky(sine):
    """DNI and DHI, W/m2, of a clear day, by the sine of the sun's altitude.

    The clear-day model of the ASHRAE Handbook of Fundamentals (1972), with its A, B and C of 21 June.
    """
    direct = 1088 * math.exp(-0.205 / sine) if sine > 0 else 0
    return direct, 0.134 * direct


def make_sky():
    sky = vtkIrradiance.vtkSunSkySource()
    sky.SetSunFromToPlaceAndTime()
    sky.SetLatitude(LATITUDE)
    sky.SetLongitude(LONGITUDE)
    sky.SetTimeZone(TIME_ZONE)
    sky.SetDirectNormalIrradiance(0)
    sky.SetDiffuseHorizontalIrradiance(0)
    return sky  # its SkyModel is Perez


def sun_direction(sky):
    return sky.GetOutput().GetFieldData().GetArray("SunDirection").GetTuple3(0)


def write_weather(sky, steps, file):
    """A series as vtkSunSkySource reads it; a file of measured weather has the same columns."""
    rows = []
    for step in range(steps):
        time = DAY + timedelta(days=step / steps)
        sky.SetDateTime(f"{time:%Y-%m-%d %H:%M:%S}")
        vtkIrradiance.update(sky)
        rows.append((sky.GetDateTime(), *(f"{value:.1f}" for value in clear_sky(sun_direction(sky)[2]))))
    write_table(file, ("time", "DNI", "DHI"), rows)
    sky.SetWeatherFileName(str(file))


def write_table(file, head, rows):
    with open(file, "w", newline="", encoding="utf-8") as table:
        csv.writer(table, lineterminator="\n").writerows([head, *rows])


def make_sheet(x, y, width, length):
    """A rectangle that faces up, in cells."""
    plane = vtkPlaneSource()
    plane.SetOrigin(x, y, 0)
    plane.SetPoint1(x + width, y, 0)
    plane.SetPoint2(x, y + length, 0)
    plane.SetResolution(math.ceil(width / CELL), math.ceil(length / CELL))
    plane.Update()
    return plane.GetOutput()


def append(meshes):
    together = vtkAppendPolyData()
    for mesh in meshes:
        together.AddInputData(mesh)
    together.Update()
    return together.GetOutput()


def make_tracker():
    """Flat, with its axis along y."""
    tracker = append(make_sheet(-LENGTH / 2, (i - MODULES / 2) * (WIDTH + GAP) + GAP / 2, LENGTH, WIDTH)
                     for i in range(MODULES))
    vtkIrradiance.add_cell_array(tracker, "DiffuseReflectance", MODULE_REFLECTANCE)
    return tracker


class Field:
    """The trackers, the ground and the light."""

    def __init__(self, options, sky):
        columns, rows = min(COLUMNS, options.trackers), math.ceil(options.trackers / COLUMNS)
        self.places = [
            (options.pitch * (i % COLUMNS - (columns - 1) / 2), ROW_SPACING * (i // COLUMNS - (rows - 1) / 2))
            for i in range(options.trackers)]
        east, north = columns * options.pitch / 2 + MARGIN, rows * ROW_SPACING / 2 + MARGIN
        ground = make_sheet(-east, -north, 2 * east, 2 * north)
        vtkIrradiance.add_cell_array(ground, "DiffuseReflectance", options.albedo)
        sky.SetGroundReflectance(options.albedo)  # of what is beyond
        sky.SetBounds(-east - CELL, east + CELL, -north - CELL, north + CELL, -0.01, AXIS_HEIGHT + LENGTH)
        self.sky = sky
        self.tilt = 0
        self.poses = [vtkTransform() for _ in self.places]
        self.irradiance = vtkIrradiance.vtkIrradianceFilter()
        self.irradiance.SetNumberOfWalks(options.walks)
        self.irradiance.SeparateSidesOn()
        self.irradiance.AddInputDataObject(0, ground)
        self.irradiance.AddInputConnection(0, sky.GetOutputPort())
        tracker = make_tracker()
        for i, pose in enumerate(self.poses):
            self.irradiance.AddInputDataObject(1, tracker)
            self.irradiance.SetDynamicTransform(i, pose)

    def is_lit(self, time):
        vtkIrradiance.update(self.sky, time=time)
        return self.sky.GetOutput().GetFieldData().GetArray("SunIrradiance").GetTuple1(0) > 0

    def light_at(self, time):
        """Turns the trackers to the sun. The blocks "ground" and "modules", which has tracker after tracker."""
        vtkIrradiance.update(self.sky, time=time)
        east, _, up = sun_direction(self.sky)
        self.tilt = max(-MOST_TILT, min(MOST_TILT, math.degrees(math.atan2(east, up))))
        for pose, place in zip(self.poses, self.places):
            pose.Identity()
            pose.Translate(*place, AXIS_HEIGHT)
            pose.RotateY(self.tilt)
        vtkIrradiance.update(self.irradiance, time=time)
        still, moving = (self.irradiance.GetOutput().GetBlock(i) for i in range(2))
        modules = append(moving.GetBlock(i) for i in range(len(self.places)))
        light = vtkMultiBlockDataSet()
        for i, (name, mesh) in enumerate((("ground", still.GetBlock(0).NewInstance()), ("modules", modules))):
            light.SetBlock(i, mesh)
            light.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
        light.GetBlock(0).ShallowCopy(still.GetBlock(0))
        return light

    def by_hand(self):
        """W/m2 on the front of a module that nothing shades and that sees a sky of one radiance and lit ground."""
        fields = self.sky.GetOutput().GetFieldData()
        direct = fields.GetArray("SunIrradiance").GetTuple1(0)
        east, _, up = sun_direction(self.sky)
        diffuse, tilt = 0.134 * direct, math.radians(self.tilt)
        facing = east * math.sin(tilt) + up * math.cos(tilt)
        sky_part = (1 + math.cos(tilt)) / 2
        ground = self.sky.GetGroundReflectance() * (diffuse + direct * up)
        return direct * facing + diffuse * sky_part + ground * (1 - sky_part)


def cells_of(light, block):
    return WrapDataObject(light.GetBlock(block)).CellData


class Insolation:
    """Irradiance, summed up over the day: the cell arrays InsolationFront and InsolationBack, kWh/m2."""

    def __init__(self):
        self.sums = {}

    def add(self, light, seconds):
        for block in range(2):
            for side in SIDES:
                self.sums[block, side] = (self.sums.get((block, side), 0) +
                                          cells_of(light, block)["Irradiance" + side] * (seconds / 3.6e6))
        self.put(light)

    def put(self, light):
        for (block, side), values in self.sums.items():
            vtkIrradiance.add_cell_array(light.GetBlock(block), "Insolation" + side, np.array(values))

    def by_tracker(self, side, trackers):
        return self.sums[1, side].reshape(trackers, -1).mean(axis=1)


def make_legend(colours, text_size):
    legend = vtkScalarBarActor()
    legend.SetLookupTable(colours)
    legend.SetLabelFormat("  %-.4g")
    legend.SetMaximumNumberOfColors(256)
    legend.UnconstrainedFontSizeOn()
    for text in (legend.GetTitleTextProperty(), legend.GetLabelTextProperty()):
        text.SetFontSize(text_size)
        text.ItalicOff()
        text.ShadowOff()
    legend.SetVerticalTitleSeparation(text_size // 2)
    legend.SetPosition(0.86, 0.15)
    legend.SetWidth(0.13)
    legend.SetHeight(0.7)
    return legend


class Film:
    """SolarRow.pvd for ParaView, and with a display a picture of each step and a film of them."""

    def __init__(self, folder, size):
        self.folder, self.data_sets, self.movie = folder, [], None
        # Where VTK draws by X it ends the program if there is no display.
        self.has_pictures = not vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") or bool(os.environ.get("DISPLAY"))
        if not self.has_pictures:
            print("No pictures: DISPLAY is not set, and VTK needs an X display (xvfb-run is one).", file=sys.stderr)
            return
        (folder / "pictures").mkdir(exist_ok=True)
        self.colours = vtkColorTransferFunction()
        self.renderer, self.mappers = vtkRenderer(), []
        self.renderer.SetBackground(0.15, 0.15, 0.17)
        for is_back in (False, False, True):  # ground, and both sides of the modules
            mapper = vtkPolyDataMapper()
            mapper.SetLookupTable(self.colours)
            mapper.UseLookupTableScalarRangeOn()
            mapper.SetScalarModeToUseCellFieldData()
            actor = vtkActor()
            actor.SetMapper(mapper)
            actor.GetProperty().LightingOff()
            actor.GetProperty().SetColor(0.3, 0.3, 0.3)  # where there is no array
            actor.GetProperty().SetBackfaceCulling(not is_back)
            actor.GetProperty().SetFrontfaceCulling(is_back)
            self.renderer.AddActor(actor)
            self.mappers.append(mapper)
        text_size = size[1] // 36
        self.legend, self.caption = make_legend(self.colours, text_size), vtkTextActor()
        self.caption.SetPosition(text_size, text_size)
        self.caption.GetTextProperty().SetFontSize(text_size)
        self.renderer.AddViewProp(self.legend)
        self.renderer.AddViewProp(self.caption)
        self.window = vtkRenderWindow()
        self.window.OffScreenRenderingOn()
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)

    def add(self, light, seconds, caption):
        number = len(self.data_sets)
        writer = vtkXMLMultiBlockDataWriter()
        writer.SetInputData(light)
        writer.SetFileName(str(self.folder / f"SolarRow/SolarRow_{number:04}.vtm"))
        writer.SetDataModeToBinary()  # Debian's ParaView cannot read the default, appended data
        writer.Write()
        self.data_sets.append(f'<DataSet timestep="{seconds}" file="SolarRow/SolarRow_{number:04}.vtm"/>')
        (self.folder / "SolarRow.pvd").write_text('<VTKFile type="Collection" version="0.1"><Collection>\n' + "\n".join(
            self.data_sets) + "\n</Collection></VTKFile>\n", encoding="utf-8")
        if not self.has_pictures:
            return
        picture = self.draw(light, ("IrradianceFront", "IrradianceFront", "IrradianceBack"), (0, 1000),
                            "W/m2", caption, f"pictures/SolarRow_{number:04}.png")
        if not self.movie:
            self.movie = vtkOggTheoraWriter()
            self.movie.SetFileName(str(self.folder / "SolarRow.ogv"))
            self.movie.SetRate(8)
            self.movie.SetInputConnection(picture.GetOutputPort())
            self.movie.Start()
        self.movie.SetInputConnection(picture.GetOutputPort())
        self.movie.Write()

    def draw(self, light, arrays, span, title, caption, name):
        """Seen from the south, from where one sees the fronts all day. An empty name: no colours."""
        self.colours.RemoveAllPoints()
        for value, colour in zip(np.linspace(*span, len(IRON)), IRON):
            self.colours.AddRGBPoint(value, *colour)
        for mapper, array, block in zip(self.mappers, arrays, (0, 1, 1)):
            mapper.SetInputData(light.GetBlock(block))
            mapper.SelectColorArray(array)
            mapper.SetScalarVisibility(bool(array))
        self.legend.SetTitle(title)
        self.caption.SetInput(caption)
        size = max(light.GetBlock(0).GetBounds())
        camera = self.renderer.GetActiveCamera()
        camera.SetViewUp(0, 0, 1)
        camera.SetPosition(0, -2.8 * size, 2.4 * size)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewAngle(28)
        camera.SetWindowCenter(0.12, 0)  # leaves a margin to the legend
        self.renderer.ResetCameraClippingRange()
        picture = vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetInputConnection(picture.GetOutputPort())
        writer.SetFileName(str(self.folder / name))
        writer.SetCompressionLevel(9)
        writer.Write()
        return picture

    def end(self):
        if self.movie:
            self.movie.End()


def size_of(text):
    if not re.fullmatch(r"\d{3,4}x\d{3,4}", text):
        raise ValueError
    return tuple(map(int, text.split("x")))


OPTIONS = (
    ("--trackers", "N", "40", "trackers of 12 modules", int),
    ("--steps", "N", "96", "steps of the day", int),
    ("--walks", "N", "1000000", "photon walks at each step", int),
    ("--pitch", "M", "5", "from axis to axis, m", float),
    ("--albedo", "X", "0.2", "of the ground, 0 to 1", float),
    ("--size", "WxH", "1280x720", "size of the pictures in pixels", size_of),
    ("--output", "FOLDER", "./SolarRow-output", "where all results go", Path),
)


def read_options():
    parser = argparse.ArgumentParser(prog="SolarRow", add_help=False, allow_abbrev=False)
    for name, value, default, _, kind in OPTIONS:
        parser.add_argument(name, metavar=value, default=default, type=kind)
    parser.add_argument("--help", action="store_true")
    options = parser.parse_args()
    if options.help:
        print("SolarRow: a day of a field of solar trackers under sun and sky.\n")
        for name, value, default, text, _ in (*OPTIONS, ("--help", "", "off", "this text", bool)):
            print(f"  {name + ' ' + value:<18}{text} ({default})")
        print("\nResults: ./SolarRow-output: weather.csv, steps.csv, trackers.csv, SolarRow.pvd, SolarRow.ogv, "
              "pictures/, insolation_front.png, insolation_back.png")
        sys.exit()
    if min(options.trackers, options.steps, options.walks, options.pitch - LENGTH) <= 0:
        parser.error(f"--trackers, --steps and --walks have to be 1 or more, --pitch more than {LENGTH:g}")
    return options


def prepare_folder(folder):
    """Makes it, and removes what an earlier run left there."""
    folder.mkdir(parents=True, exist_ok=True)
    ours = re.compile(r"SolarRow\.(pvd|ogv)|SolarRow_\d{4}(_\d\.vtp|\.vtm|\.png)|insolation_(front|back)\.png|"
                      r"(weather|steps|trackers)\.csv")
    for file in folder.rglob("*"):
        if ours.fullmatch(file.name):
            file.unlink()


def write_day(options, field, day, film, light):
    """The table of the trackers, and pictures of both sides, in a pose in which one sees the modules well."""
    front, back = (day.by_tracker(side, options.trackers) for side in SIDES)
    gain = 100 * BIFACIALITY * back / front
    write_table(options.output / "trackers.csv",
                ("tracker", "x_m", "y_m", "front_kWh_m2", "back_kWh_m2", "gain_percent"),
                ((i + 1, *place, f"{front[i]:.3f}", f"{back[i]:.3f}", f"{gain[i]:.2f}")
                 for i, place in enumerate(field.places)))
    day.put(light)
    for side in SIDES if film.has_pictures else ():
        span = np.percentile(day.sums[1, side], (2, 98))  # a few cells at edges shall not darken the others
        film.draw(light, ("", *2 * ("Insolation" + side,)), span, "kWh/m2", f"The {side.lower()}s, the whole day",
                  f"insolation_{side.lower()}.png")
    print(f"The day: front {front.mean():.2f} kWh/m2, back {back.mean():.3f} ({back.min():.3f} to {back.max():.3f}), "
          f"bifacial gain {gain.mean():.1f} %")


def main():
    options = read_options()
    prepare_folder(options.output)
    sky = make_sky()
    write_weather(sky, options.steps, options.output / "weather.csv")
    field, film, day = Field(options, sky), Film(options.output, options.size), Insolation()
    seconds = 86400 / options.steps
    rows, noon = [], None
    for time in filter(field.is_lit, (seconds * step for step in range(options.steps))):
        light = field.light_at(time)
        day.add(light, seconds)
        front, back = (cells_of(light, 1)["Irradiance" + side].mean() for side in SIDES)
        clock = f"{DAY + timedelta(seconds=time):%H:%M}"
        text = f"{clock}  tilt {field.tilt:5.1f} degrees  front {front:6.1f}  back {back:5.1f} W/m2"
        print(text, flush=True)
        film.add(light, time, text)
        rows.append((clock, *(f"{value:.1f}" for value in (field.tilt, front, back))))
        if not noon or sun_direction(sky)[2] > noon[0]:
            noon = sun_direction(sky)[2], light, front, field.by_hand()
    film.end()
    if not noon:
        sys.exit("SolarRow: the sun is down at all steps; take more")

    write_table(options.output / "steps.csv", ("time", "tilt_degrees", "front_W_m2", "back_W_m2"), rows)
    _, light, highest, by_hand = noon
    write_day(options, field, day, film, light)
    is_right = abs(highest / by_hand - 1) < 0.05
    print(f"Front with the sun highest: {highest:.1f} W/m2, by hand {by_hand:.1f}" + ("" if is_right else ": WRONG"))
    print(f"Written to {options.output}: weather.csv, steps.csv, trackers.csv, SolarRow.pvd" +
          (", SolarRow.ogv, pictures/, insolation_*.png" if film.has_pictures else ""))
    return 0 if is_right else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, RuntimeError) as error:
        sys.exit(f"SolarRow: {error}")
