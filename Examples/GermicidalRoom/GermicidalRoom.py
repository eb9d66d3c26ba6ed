# SPDX-License-Identifier: BSD-3-Clause
"""Ultraviolet germicidal irradiation of a hospital room: a robot with a tube of 254 nm drives through it, and a lamp
cleans the upper air. What each of them brings to surfaces, to the air and to a person behind a curtain of film.

Documentation/GermicidalRoom.md tells more.
"""
import argparse
import csv
import math
import os
import re
import sys
from pathlib import Path

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2

from Film import Film
from HospitalRoom import FACE, SECONDS, TOUR, TUBE_LENGTH, TUBE_MIDDLE, TUBE_POWER, make_light
import vtkIrradiance

HELP = """GermicidalRoom: a robot with a germicidal lamp drives through a hospital room with a lamp for the upper air.

  --walks N        photon walks of each lamp (500000)
  --frames N       times of the tour, 10 minutes (41)
  --cell METRES    the largest cells of room and beds (0.1)
  --ceiling X      its reflectance, 0 to 0.9 (0.2)
  --film X         what the film of the curtain lets through, 0 to 0.9 (0.3)
  --output FOLDER  where all results go (./GermicidalRoom-output)
  --help           this text (off)

Results: ./GermicidalRoom-output: Surfaces.csv, Air.csv, Dose.vtm, GermicidalRoom*.png, GermicidalRoom.ogv, pictures/
"""
GROUPS = "robot", "upper"
# J/m2 for a tenfold reduction, by what was measured, and taken as exponential.
GERMS = {
    "SARS-CoV-2": 37 / 3,  # 3.7 mJ/cm2: 3 decades (Biasin et al. 2021)
    "C. difficile": 220 / 2,  # spores, 22,000 uWs/cm2: 2 decades or more (Nerandzic et al. 2010)
}
LIMIT = 60  # J/m2 of 254 nm in 8 hours for eyes and skin (ICNIRP 2004)
SURFACES = {  # block: the height above which a cell belongs to the surface, m
    "bed A": 0.549, "bed B": 0.549, "table": 0.749, "door handle": 0, "face": 0}
BESIDE = 0.3  # m from the tube, where the robot waits
AIR = {  # m
    "above bed A": (1.4, 2.9, 1.2), "above bed B": (4.6, 2.9, 1.2), "before the face": (FACE[0] - 0.15, *FACE[1:]),
    "upper air": (3, 2, 2.4), "beside the robot": (TOUR[0][1] - BESIDE, TOUR[0][2], TUBE_MIDDLE)}


def make_probe(light):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for place in AIR.values():
        points.InsertNextPoint(place)
    air = vtkPolyData()
    air.SetPoints(points)
    probe = vtkIrradiance.vtkIrradianceProbeFilter()
    probe.SetInputData(air)
    probe.SetSourceConnection(light.GetOutputPort())
    probe.SetNumberOfRays(256)
    return probe


def fluence_rates(probe):
    """W/m2 at each place, by group; 0 while a group is off."""
    values = WrapDataObject(probe.GetOutput()).PointData
    return np.array([np.asarray(values["FluenceRate_" + group]) for group in GROUPS]).T


def by_hand():
    """W/m2 of fluence rate that a diffuse line brings to the point beside the robot at rest."""
    angle = math.atan(TUBE_LENGTH / 2 / BESIDE)  # of half the tube, seen from there
    return 2 * TUBE_POWER * math.sin(angle) / (math.pi ** 2 * TUBE_LENGTH * BESIDE)


def doses_of(output):
    """J/m2 of the cells of each surface, by group."""
    for block in output:
        name = block.FieldData["Name"].GetValue(0)
        if name in SURFACES:
            corners = block.Points[block.Polygons.reshape(-1, block.Polygons[0] + 1)[:, 1:]]
            belongs = np.asarray(corners)[:, :, 2].min(axis=1) >= SURFACES[name]
            whole = np.asarray(block.CellData["RadiantExposureFront"])[belongs]
            parts = [np.asarray(block.CellData["RadiantExposureFront_" + group])[belongs] for group in GROUPS]
            np.testing.assert_allclose(sum(parts), whole, rtol=1e-9, atol=1e-12)
            yield name, whole, parts


def write_table(file, head, rows):
    with open(file, "w", newline="", encoding="utf-8") as table:
        csv.writer(table, lineterminator="\n").writerows([head, *rows])


def write_surfaces(file, output):
    """Cells of a surface hardly differ in size, so means are those of cells."""
    rows = []
    for name, whole, parts in doses_of(output):
        # Who survives on a surface is the mean over its cells, not that of the mean dose.
        logs = [-math.log10(max(np.mean(10 ** (-whole / dose)), 1e-99)) for dose in GERMS.values()]
        doses = (*map(np.mean, parts), whole.mean(), whole.min(), whole.max())
        rows.append([name, *(f"{dose:.4g}" for dose in doses), *(f"{log:.2f}" for log in logs)])
        print(f"{name:<12} robot {doses[0]:7.1f}, upper {doses[1]:6.2f} J/m2; log reduction " +
              ", ".join(f"{germ} {min(log, 6):.1f}{' or more' if log > 6 else ''}" for germ, log in zip(GERMS, logs)))
        if name == "face":
            print(f"             at most {doses[-1]:.1f} J/m2 on the face: {doses[-1] / LIMIT:.1f} of the limit")
    write_table(file, ["surface", *(f"{group}_J_m2" for group in GROUPS), "mean_J_m2", "min_J_m2", "max_J_m2",
                       *(f"log10_{germ}" for germ in GERMS)], rows)


def write_air(file, rates, times):
    """`rates`: W/m2 by time, place and group."""
    steps = np.diff(times)[:, None, None]
    doses = (steps * (rates[1:] + rates[:-1]) / 2).sum(axis=0)
    write_table(file, ["place", *(f"{group}_J_m2" for group in GROUPS), *(f"{group}_most_W_m2" for group in GROUPS)],
                [[place, *(f"{value:.4g}" for value in (*dose, *most))]
                 for place, dose, most in zip(AIR, doses, rates.max(axis=0))])
    for place, dose in zip(AIR, doses):
        print(f"{place:<17}fluence: robot {dose[0]:7.1f}, upper {dose[1]:6.2f} J/m2")


def prepare_folder(folder):
    """Makes it, and removes what an earlier run left there."""
    folder.mkdir(parents=True, exist_ok=True)
    ours = re.compile(r"(Surfaces|Air)\.csv|Dose(_\d+(_\d+)?\.vtp|\.vtm)|"
                      r"GermicidalRoom(_\d{4}|_robot|_upper)?\.(png|ogv)")
    for file in folder.rglob("*"):
        if ours.fullmatch(file.name):
            file.unlink()


def read_options():
    parser = argparse.ArgumentParser(prog="GermicidalRoom")
    parser.format_help = lambda: HELP
    for name, kind, default in (("--walks", int, 500000), ("--frames", int, 41), ("--cell", float, 0.1),
                                ("--ceiling", float, 0.2), ("--film", float, 0.3),
                                ("--output", Path, Path("GermicidalRoom-output"))):
        parser.add_argument(name, type=kind, default=default)
    options = parser.parse_args()
    if options.walks < 1 or options.frames < 3 or options.cell <= 0 or not (
            0 <= options.ceiling <= 0.9 and 0 <= options.film <= 0.9):
        parser.error("--walks has to be 1 or more, --frames 3 or more, --cell more than 0, "
                     "--ceiling and --film 0 to 0.9")
    return options


def main():
    options = read_options()
    prepare_folder(options.output)
    # Where VTK draws by X it ends the program if there is no display.
    film = None
    if vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY"):
        print("No pictures: DISPLAY is not set, and VTK needs an X display (xvfb-run is one).", file=sys.stderr)
    else:
        film = Film(options.output)
    light = make_light(options)
    probe = make_probe(light)
    times, rates = np.linspace(0, SECONDS, options.frames), []
    for frame, time in enumerate(times):
        vtkIrradiance.update(probe, time=time)  # shoots the robot's walks, and repairs those of the other lamp
        rates.append(fluence_rates(probe))
        if film:
            film.add(WrapDataObject(light.GetOutput()), f"GermicidalRoom_{frame:04}", f"{time:3.0f} s")

    dose = vtkIrradiance.vtkRadiantExposureFilter()
    dose.SetInputConnection(light.GetOutputPort())
    dose.SetIntegrationModeToUniform()
    dose.SetNumberOfTimeSteps(options.frames - 1)
    vtkIrradiance.update(dose)
    output = WrapDataObject(dose.GetOutputDataObject(0))
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputData(output.VTKObject)
    writer.SetFileName(str(options.output / "Dose.vtm"))
    writer.SetDataModeToBinary()  # Debian's ParaView cannot read the default, appended data
    writer.Write()
    write_surfaces(options.output / "Surfaces.csv", output)
    write_air(options.output / "Air.csv", np.array(rates), times)
    if film:
        film.end()
        for part, whose in (("", "both lamps"), ("_robot", "the robot"), ("_upper", "the lamp for the upper air")):
            film.draw(output, "RadiantExposureFront" + part, "J/m2", (0.1, 1e4), f"The dose of {whose}, ten minutes",
                      f"GermicidalRoom{part}.png")

    found, expected = rates[0][list(AIR).index("beside the robot"), 0], by_hand()
    is_right = abs(found / expected - 1) < 0.05
    print(f"Beside the robot: {found:.2f} W/m2, by hand without reflections {expected:.2f}" +
          ("" if is_right else ": WRONG"))
    print(f"Written to {options.output}: Surfaces.csv, Air.csv, Dose.vtm" +
          (", GermicidalRoom*.png, GermicidalRoom.ogv, pictures/" if film else ""))
    return 0 if is_right else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (OSError, RuntimeError) as error:
        sys.exit(f"GermicidalRoom: {error}")
