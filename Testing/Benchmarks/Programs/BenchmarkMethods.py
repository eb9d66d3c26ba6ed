# SPDX-License-Identifier: BSD-3-Clause
"""Four methods in the same CPU time of one thread, that in which all cells gather: errors on walls and on a ball of
small cells in a lit room; and, where there is a display, pictures of them, two and four in one file.

    BenchmarkMethods.py [SEEDS [TWO.png FOUR.png]]

The room is that of Examples/LitRoom, with a lamp of 1 m2. The truth are 12 long runs with other seeds.
"""
import os
import sys
import time
from pathlib import Path

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkSphereSource

import vtkIrradiance

sys.path.append(str(Path(__file__).resolve().parents[3] / "Examples/LitRoom"))
import LitRoom

WAYS = ("shot", "shot, spread", "gathered", "all gathered")


def make_lamp():
    """One metre square."""
    lamp = LitRoom.make_lamp()
    points = WrapDataObject(lamp).Points
    points[:, :2] *= 0.5
    lamp.GetPoints().Modified()
    return lamp


def make_filter(reflectance):
    room = LitRoom.make_room()
    ball_source = vtkSphereSource()
    ball_source.SetThetaResolution(32)
    ball_source.SetPhiResolution(32)
    pose = vtkTransform()
    pose.Translate(0, 0, 1.2)
    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.AddInputConnection(0, room.GetOutputPort())
    irradiance.AddInputDataObject(0, make_lamp())
    irradiance.AddInputConnection(1, ball_source.GetOutputPort())
    irradiance.SetDynamicTransform(0, pose)
    irradiance.SetDefaultDiffuseReflectance(reflectance)
    irradiance.SetUpdateModeToRebuild()
    return irradiance


def executed(irradiance, way, walks, seed):
    """Seconds of all threads."""
    irradiance.SetDirectLight(irradiance.Gathered if "gathered" in way else irradiance.Shot)
    estimates = {"shot, spread": irradiance.Spread, "all gathered": irradiance.FinalGather}
    irradiance.SetCellEstimate(estimates.get(way, irradiance.Sums))
    irradiance.SetGatherOnToAllCells()
    irradiance.SetNumberOfRays(16)
    irradiance.SetNumberOfWalks(walks)
    irradiance.SetSeed(seed)
    start = time.process_time()
    vtkIrradiance.update(irradiance)
    return time.process_time() - start


def surface_of(irradiance, number):
    return np.array(WrapDataObject(irradiance.GetOutput()).CellData["Irradiance"].Arrays[number])


def walks_in(irradiance, way, seconds):
    """How many walks take that long."""
    walks = 20000
    for _ in range(4):
        taken = np.median([executed(irradiance, way, walks, seed) for seed in (1, 2, 3)])
        walks = int(np.clip(walks * seconds / taken, walks / 8, walks * 8))
    return walks


ROOM, BALL = 0, 2  # the lamp is between them
WALKS_OF_ALL = 300000  # so walls expect some 100 photons a cell


def time_of_all(irradiance):
    return np.median([executed(irradiance, "all gathered", WALKS_OF_ALL, seed) for seed in (1, 2, 3)])


def walks_of(irradiance, way, seconds):
    return WALKS_OF_ALL if way == "all gathered" else walks_in(irradiance, way, seconds)


def report(way, quantity, value):
    print(f'"Ways","{way}","{quantity}",{value:.6g},nan,nan')


def truth_of(irradiance):
    runs = []
    for seed in range(1001, 1013):
        executed(irradiance, "gathered", 4000000, seed)
        runs.append([surface_of(irradiance, number) for number in (ROOM, BALL)])
    return dict(zip((ROOM, BALL), (np.mean(fields, axis=0) for fields in zip(*runs))))


def measure(room, seeds):
    truth = truth_of(room)
    seconds = time_of_all(room)
    for way in WAYS:
        walks = walks_of(room, way, seconds)
        times, squares = [], {ROOM: [], BALL: []}
        for seed in range(1, seeds + 1):
            times.append(executed(room, way, walks, seed))
            for number in squares:
                squares[number].append(np.mean((surface_of(room, number) - truth[number]) ** 2))
        report(way, "CPU time, s", np.median(times))
        report(way, "walks", walks)
        for number, name in ((ROOM, "walls"), (BALL, "ball")):
            error = np.sqrt(np.mean(squares[number])) / truth[number].mean()
            report(way, f"RMS error on the {name}, %", 100 * error)


def draw(name, reflectance, ways, seconds=None):
    """In the same colours, two in a row. Without a time: in that of all cells that gather."""
    from vtkmodules.vtkFiltersCore import vtkImageAppend
    from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

    irradiance = make_filter(reflectance)
    executed(irradiance, "gathered", 4000000, 9)
    brightest = surface_of(irradiance, ROOM).max()
    LitRoom.most_of = lambda _: brightest
    seconds = seconds or time_of_all(irradiance)
    rows = vtkImageAppend()
    rows.SetAppendAxis(1)
    for first in range(len(ways) - 2, -1, -2):  # from below
        row = vtkImageAppend()
        for way in ways[first:first + 2]:
            walks = walks_of(irradiance, way, seconds)
            taken = executed(irradiance, way, walks, 1)
            print(f"picture: {way}, {walks} walks, {taken:.3f} s", file=sys.stderr)
            LitRoom.write_picture(WrapDataObject(irradiance.GetOutput()), name)
            reader = vtkPNGReader()
            reader.SetFileName(name)
            reader.Update()
            row.AddInputConnection(reader.GetOutputPort())
        row.Update()
        rows.AddInputConnection(row.GetOutputPort())
    writer = vtkPNGWriter()
    writer.SetInputConnection(rows.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()


def main(seeds="15", two="", four=""):
    measure(make_filter(0.5), int(seeds))
    if four and os.environ.get("DISPLAY"):
        draw(two, 0.2, ("shot", "gathered"), 0.05)
        draw(four, 0.5, WAYS)


if __name__ == "__main__":
    main(*sys.argv[1:])
