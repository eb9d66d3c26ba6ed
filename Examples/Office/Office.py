# SPDX-License-Identifier: BSD-3-Clause
"""An office by the light of its luminaires, as their photometric files say, while somebody walks through it.

Writes two such files, an IES and a EULUMDAT one, as manufacturers give them, reads them by vtkLuminaireReader, hangs
12 luminaires and lets a person walk between the desks. Documentation/Office.md tells more.
"""
import argparse
import csv
import os
import shutil
import sys
from pathlib import Path

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkArrayCalculator, vtkCleanPolyData
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkCapsuleSource, vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2

from Film import Film
from LampFiles import write_eulumdat, write_ies
import vtkIrradiance

HELP = """Office: an office by the light of 12 luminaires from an IES and a EULUMDAT file; somebody walks through it.

  --walks N        photon walks (4000000)
  --frames N       frames of the walk through the office (24)
  --cell METRES    the largest cells of room and desks (0.1)
  --output FOLDER  where all results go (./Office-output)
  --help           this text (off)

Results: ./Office-output: Desks.csv, Office.pvd, ParaViewState.py, Office.png, Office.ogv, pictures/, the lamp files
"""
LENGTH, WIDTH, HEIGHT = 12, 8, 3  # of the office, m
DESK = 0.75  # m above the floor
ISLANDS = [(x, y) for x in (3, 9) for y in (2.2, 5.8)]  # the middles of two desks that face each other
PANELS = [(x, y) for x in (1.5, 4.5, 7.5, 10.5) for y in (2, 6)]
EFFICACY = 300  # lumens in a watt of the light of white LEDs, typically
SECONDS = 12  # of the walk
WALK = [(0, 0.6, 4), (3, 4.2, 4), (5.6, 4.2, 0.8), (8.4, 7.8, 0.8), (11, 7.8, 4), (12, 9, 4)]  # s, m, m


def hang(file, name, poses):
    """The luminaire of a file at each of these transforms."""
    reader = vtkIrradiance.vtkLuminaireReader()
    reader.SetFileName(str(file))
    reader.SetLuminousEfficacy(EFFICACY)  # makes W/sr of candela
    vtkIrradiance.update(reader)
    lamps = []
    for number, pose in enumerate(poses):
        lamp = vtkTransformPolyDataFilter()  # turns its light as well
        lamp.SetInputConnection(reader.GetOutputPort())
        lamp.SetTransform(pose)
        lamp.Update()
        vtkIrradiance.add_cell_array(lamp.GetOutput(), "LampId", number)  # whose opening a face is
        lamps.append(lamp.GetOutput())
    return named(join(lamps), name)


def pose_at(x, y, z, turn=0):
    pose = vtkTransform()
    pose.Translate(x, y, z)
    pose.RotateZ(turn)
    return pose


# What stands in the office.

def named(mesh, name):
    """What its block is called in the output."""
    array = vtkStringArray()
    array.SetName("Name")
    array.InsertNextValue(name)
    mesh.GetFieldData().AddArray(array)
    return mesh


def join(meshes):
    append = vtkAppendPolyData()
    for mesh in meshes:
        append.AddInputData(mesh)
    append.Update()
    return append.GetOutput()


def box(low, high, cell, reflectances, inward=False):
    """Six faces of quads with their front outside, unless `inward`. `reflectances`: of -x, +x, -y, +y, -z, +z."""
    low, high = np.array(low, float), np.array(high, float)
    faces = []
    for side, reflectance in enumerate(reflectances):
        axis, is_high = divmod(side, 2)
        u, v = (axis + 1) % 3, (axis + 2) % 3
        if bool(is_high) == inward:
            u, v = v, u
        plane = vtkPlaneSource()
        origin = low.copy()
        origin[axis] = high[axis] if is_high else low[axis]
        ends = [origin.copy(), origin.copy()]
        ends[0][u], ends[1][v] = high[u], high[v]
        plane.SetOrigin(*origin)
        plane.SetPoint1(*ends[0])
        plane.SetPoint2(*ends[1])
        plane.SetResolution(*(max(1, round((high[i] - low[i]) / cell)) for i in (u, v)))
        plane.Update()
        plane.GetOutput().GetPointData().Initialize()
        vtkIrradiance.add_cell_array(plane.GetOutput(), "DiffuseReflectance", reflectance)
        faces.append(plane.GetOutput())
    clean = vtkCleanPolyData()  # faces share the points of their edges: no light gets between
    clean.SetInputData(join(faces))
    clean.Update()
    return clean.GetOutput()


def slab(middle, size, cell=1, reflectance=0.5):
    """A box around the middle of its lower face."""
    x, y, z = middle
    half = size[0] / 2, size[1] / 2
    return box((x - half[0], y - half[1], z), (x + half[0], y + half[1], z + size[2]), cell, [reflectance] * 6)


def make_desk(x, y, cell, name):
    legs = [slab((x + side * 0.77, y, 0), (0.03, 0.7, DESK - 0.03)) for side in (-1, 1)]
    return named(join([slab((x, y, DESK - 0.03), (1.6, 0.8, 0.03), cell), *legs]), name)


def make_chair(x, y, back):
    """`back`: towards which y its back stands, -1 or 1."""
    parts = [slab((x, y, 0), (0.08, 0.08, 0.42), 1, 0.3), slab((x, y, 0.42), (0.45, 0.45, 0.06), 0.15, 0.3),
             slab((x, y + 0.2 * back, 0.55), (0.45, 0.05, 0.45), 0.15, 0.3)]
    return join(parts)


def make_person():
    """A capsule 1.75 m high, with its feet in the origin."""
    capsule = vtkCapsuleSource()
    capsule.SetRadius(0.22)
    capsule.SetCylinderLength(1.75 - 2 * 0.22)
    capsule.SetThetaResolution(12)
    capsule.SetPhiResolution(12)
    pose = pose_at(0, 0, 1.75 / 2)
    pose.RotateX(90)  # its axis is y
    person = vtkTransformPolyDataFilter()
    person.SetInputConnection(capsule.GetOutputPort())
    person.SetTransform(pose)
    person.Update()
    vtkIrradiance.add_cell_array(person.GetOutput(), "DiffuseReflectance", 0.3)
    return named(person.GetOutput(), "person")


def make_light(folder, walks, cell):
    """The filter, and what it is given that stays: room, luminaires, chairs, desks."""
    write_ies(folder / "Panel.ies", 2600)
    write_eulumdat(folder / "Pendant.ldt", 3600)
    room = box((0, 0, 0), (LENGTH, WIDTH, HEIGHT), cell, [0.5, 0.5, 0.5, 0.5, 0.2, 0.7], inward=True)
    panels = hang(folder / "Panel.ies", "panels", [pose_at(x, y, HEIGHT) for x, y in PANELS])  # flush
    pendants = hang(folder / "Pendant.ldt", "pendants", [pose_at(x, y, 2, 90) for x, y in ISLANDS])
    places = [(x, y + 0.4 * side, side) for x, y in ISLANDS for side in (-1, 1)]
    chairs = named(join([make_chair(x, y + 0.75 * side, side) for x, y, side in places]), "chairs")
    desks = [make_desk(x, y, cell, f"desk{i + 1}") for i, (x, y, side) in enumerate(places)]

    pose = vtkIrradiance.vtkKeyFramedPose()
    pose.SetInputData(make_person())
    for time, x, y in WALK:
        pose.AddPose(time, x, y, 0, 0, 0, 0)

    irradiance = vtkIrradiance.vtkIrradianceFilter()
    for mesh in (named(room, "room"), panels, pendants, chairs, *desks):
        irradiance.AddInputDataObject(0, mesh)
    irradiance.AddInputConnection(1, pose.GetOutputPort())
    irradiance.SetNumberOfWalks(walks)
    irradiance.SetMethodToGatheredEverywhere()  # no grain
    illuminance = vtkArrayCalculator()  # of all blocks
    illuminance.SetInputConnection(irradiance.GetOutputPort())
    illuminance.SetAttributeTypeToCellData()
    illuminance.AddScalarArrayName("Irradiance")
    illuminance.SetFunction(f"{EFFICACY} * Irradiance")
    illuminance.SetResultArrayName("Illuminance")  # lx
    return illuminance


# What comes out.

def tops_of(output):
    """Irradiance of the cells on top of each desk, which all have one size."""
    for block in list(output)[4:-1]:
        points = block.Points[block.Polygons.reshape(-1, 5)[:, 1:]]
        yield np.asarray(block.CellData["Irradiance"])[points[:, :, 2].min(axis=1) > DESK - 1e-4]


def write_table(path, frames):
    """`frames`: of each frame the irradiance on each desk."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["desk", "mean (W/m2)", "min (W/m2)", "U0", "mean (lx)", "min (lx)",
                        "least mean while one walks (lx)", "at (s)"])
        for desk, first in enumerate(frames[0]):
            means = [frame[desk].mean() for frame in frames]
            least = int(np.argmin(means))
            row = [desk + 1, first.mean(), first.min(), first.min() / first.mean(), EFFICACY * first.mean(),
                   EFFICACY * first.min(), EFFICACY * means[least], time_of(least, len(frames))]
            table.writerow([f"{value:.4g}" for value in row])
            print("desk {}: {:.2f} W/m2, {:.0f} lx, U0 {:.2f}; at least {:.0f} lx, {:.1f} s".format(
                row[0], row[1], row[4], row[3], row[6], row[7]))


def time_of(frame, frames):
    return SECONDS * frame / max(1, frames - 1)


def prepare_folder(folder):
    """Takes away what an earlier run left."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("Desks.csv", "Office.pvd", "ParaViewState.py", "Office.png", "Office.ogv"):
        (folder / name).unlink(missing_ok=True)
    for name in ("Office", "pictures"):
        shutil.rmtree(folder / name, ignore_errors=True)
    (folder / "Office").mkdir()
    state = (Path(__file__).parent.parent / "ParaViewState.py").read_text(encoding="utf-8")
    (folder / "ParaViewState.py").write_text(f'FOLDER = "{folder.absolute()}"\n{state}', encoding="utf-8")


def write_series(folder, times):
    """The list of files with their times is ParaView's own; VTK has no writer for it."""
    sets = "\n".join(f'<DataSet timestep="{time:g}" part="0" file="Office/Office_{frame:04}.vtm"/>'
                     for frame, time in enumerate(times))
    (folder / "Office.pvd").write_text(
        f'<VTKFile type="Collection" version="0.1"><Collection>\n{sets}\n</Collection></VTKFile>\n', encoding="utf-8")


def read_options():
    parser = argparse.ArgumentParser(prog="Office")
    parser.format_help = lambda: HELP
    parser.add_argument("--walks", type=int, default=4000000)
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--cell", type=float, default=0.1)
    parser.add_argument("--output", type=Path, default=Path("Office-output"))
    return parser.parse_args()


def main():
    options = read_options()
    folder = options.output
    prepare_folder(folder)
    # Where VTK draws by X it ends the program if there is no display.
    film = None
    if vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY"):
        print("No pictures: DISPLAY is not set, and VTK needs an X display (xvfb-run is one).", file=sys.stderr)
    else:
        film = Film(folder)
    light = make_light(folder, options.walks, options.cell)
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputConnection(light.GetOutputPort())
    writer.SetDataModeToBinary()  # Debian's ParaView cannot read the default, appended data
    frames, times = [], [time_of(frame, options.frames) for frame in range(options.frames)]
    for frame, time in enumerate(times):
        vtkIrradiance.update(light, time=time)  # shoots again only what the person has changed
        report = light.GetOutput().GetFieldData()
        print(f"{time:4.1f} s: {report.GetArray('NumberOfRepairedSegments').GetTuple1(0):g} of "
              f"{report.GetArray('NumberOfSegments').GetTuple1(0):g} segments shot again")
        output = WrapDataObject(light.GetOutput())
        frames.append(list(tops_of(output)))
        writer.SetFileName(str(folder / "Office" / f"Office_{frame:04}.vtm"))
        writer.Write()
        if film:
            film.add(output, f"Office_{frame:04}", f"{time:.1f} s")
    write_series(folder, times)
    write_table(folder / "Desks.csv", frames)
    if film:
        film.end()


if __name__ == "__main__":
    main()
