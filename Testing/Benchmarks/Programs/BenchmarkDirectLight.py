# SPDX-License-Identifier: BSD-3-Clause
"""Direct light shot beside gathered, in the same CPU time of one thread: errors in the penumbra under a ball and
elsewhere; these and two further ways to estimate cells in the time in which all of them gather; what a million walks
give who chooses none of them, beside light that is shot; and, where there is a
display, a picture of a lit room for each, two and four in one file.

    BenchmarkDirectLight.py [SEEDS [TWO.png FOUR.png]]

The room is that of Examples/LitRoom, with a lamp of 1 m2, or its floor alone in 8 x 8 cells. The truth are 12 long runs
with other seeds.
"""
import os
import sys
import time
from pathlib import Path

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource

import vtkIrradiance

sys.path.append(str(Path(__file__).resolve().parents[3] / "Examples/LitRoom"))
import LitRoom

# Of direct light alone, and of all light.
WAYS = ("shot", "gathered")
ALL_WAYS = ("shot", "shot, spread", "gathered", "all gathered")


def make_floor():
    floor = vtkPlaneSource()
    floor.SetOrigin(-2, -2, 0)
    floor.SetPoint1(2, -2, 0)
    floor.SetPoint2(-2, 2, 0)
    floor.SetResolution(8, 8)
    return floor


def make_lamp():
    """One metre square."""
    lamp = LitRoom.make_lamp()
    points = WrapDataObject(lamp).Points
    points[:, :2] *= 0.5
    lamp.GetPoints().Modified()
    return lamp


def make_filter(surface, ball=True):
    ball_source = vtkSphereSource()
    ball_source.SetThetaResolution(32)
    ball_source.SetPhiResolution(32)
    pose = vtkTransform()
    pose.Translate(0, 0, 1.2)
    irradiance = vtkIrradiance.vtkIrradianceFilter()
    irradiance.AddInputConnection(0, surface.GetOutputPort())
    irradiance.AddInputDataObject(0, make_lamp())
    if ball:
        irradiance.AddInputConnection(1, ball_source.GetOutputPort())
        irradiance.SetDynamicTransform(0, pose)
    irradiance.SetUpdateModeToRebuild()
    return irradiance


def seconds_of_update(irradiance):
    """Of all threads."""
    start = time.process_time()
    vtkIrradiance.update(irradiance)
    return time.process_time() - start


def executed(irradiance, way, walks, seed):
    """Seconds of all threads."""
    irradiance.SetDirectLight(irradiance.Gathered if "gathered" in way else irradiance.Shot)
    estimates = {"shot, spread": irradiance.Spread, "all gathered": irradiance.FinalGather}
    irradiance.SetCellEstimate(estimates.get(way, irradiance.Sums))
    irradiance.SetGatherOnToAllCells()
    irradiance.SetNumberOfRays(16)
    irradiance.SetNumberOfWalks(walks)
    irradiance.SetSeed(seed)
    return seconds_of_update(irradiance)


def surface_of(irradiance, number=0):
    return np.array(WrapDataObject(irradiance.GetOutput()).CellData["Irradiance"].Arrays[number])


def walks_in(irradiance, way, seconds):
    """How many walks take that long."""
    walks = 20000
    for _ in range(4):
        taken = np.median([executed(irradiance, way, walks, seed) for seed in (1, 2, 3)])
        walks = int(np.clip(walks * seconds / taken, walks / 8, walks * 8))
    return walks


def mean_of(irradiance, way, walks, seeds, number=0):
    fields = []
    for seed in seeds:
        executed(irradiance, way, walks, seed)
        fields.append(surface_of(irradiance, number))
    return np.mean(fields, axis=0)


def report(table, row, quantity, value, bar="nan", aim="nan"):
    print(f'"{table}","{row}","{quantity}",{value:.6g},{bar},{aim}')


def measure(table, name, irradiance, truth, sets, seeds, seconds, goal=("nan", "nan")):
    """The errors of sets of cells of one size, in units of their means, in this time."""
    errors = {}
    for way in WAYS:
        walks = walks_in(irradiance, way, seconds)
        times, squares = [], []
        for seed in range(1, seeds + 1):
            times.append(executed(irradiance, way, walks, seed))
            squares.append((surface_of(irradiance) - truth) ** 2)
        report(table, f"{name}, {way}", "CPU time, s", np.median(times))
        report(table, f"{name}, {way}", "walks", walks)
        for cells, mask in sets.items():
            errors[way, cells] = np.sqrt(np.mean(squares, axis=0)[mask].mean()) / truth[mask].mean()
            report(table, f"{name}, {way}", f"RMS error {cells}, %", 100 * errors[way, cells])
    for cells in sets:
        report(table, f"{name}, gathered", f"error {cells} / shot",
               errors["gathered", cells] / errors["shot", cells], *goal)


def penumbra_of(surface):
    """The cells that receive from 5 to 95 % of the direct light that they would receive without the ball."""
    direct = []
    for ball in (True, False):
        irradiance = make_filter(surface, ball)
        irradiance.SetDefaultDiffuseReflectance(0)
        direct.append(mean_of(irradiance, "gathered", 4000000, (1001, 1002)))
    return (direct[0] > 0.05 * direct[1]) & (direct[0] < 0.95 * direct[1])


def truth_of(irradiance):
    """Gathered, which has less noise; light that is shot must have the same mean."""
    means = [mean_of(irradiance, way, 3000000, range(1001, 1013)) for way in WAYS]
    off = abs(means[0].mean() / means[1].mean() - 1)
    if off > 0.005:
        sys.exit(f"the means of all cells, shot and gathered, are {100 * off:.2g} % apart")
    return means[1]


ROOM, BALL = 0, 2  # the lamp is between them
WALKS_OF_ALL = 300000  # so walls expect some 100 photons a cell


def time_of_all(irradiance):
    return np.median([executed(irradiance, "all gathered", WALKS_OF_ALL, seed) for seed in (1, 2, 3)])


def walks_of(irradiance, way, seconds):
    return WALKS_OF_ALL if way == "all gathered" else walks_in(irradiance, way, seconds)


def measure_ways(room, seeds):
    """All ways in the time that gathering on all cells takes, on the walls and on the ball."""
    truth = {number: mean_of(room, "gathered", 4000000, range(1001, 1013), number) for number in (ROOM, BALL)}
    seconds = time_of_all(room)
    for way in ALL_WAYS:
        walks = walks_of(room, way, seconds)
        times, squares = [], {ROOM: [], BALL: []}
        for seed in range(1, seeds + 1):
            times.append(executed(room, way, walks, seed))
            for number in squares:
                squares[number].append(np.mean((surface_of(room, number) - truth[number]) ** 2))
        report("Ways", way, "CPU time, s", np.median(times))
        report("Ways", way, "walks", walks)
        for number, name in ((ROOM, "walls"), (BALL, "ball")):
            error = np.sqrt(np.mean(squares[number])) / truth[number].mean()
            report("Ways", way, f"RMS error on the {name}, %", 100 * error)


def measure_defaults(name, room, seeds):
    """A first frame of a million walks, and one after a motion, shot and without a choice."""
    truth = {number: mean_of(room, "gathered", 4000000, range(1001, 1013), number) for number in (ROOM, BALL)}
    room.SetUpdateModeToVerify()
    room.SetCellEstimateToAutomatic()
    room.SetGatherOnToSmallCells()
    room.SetNumberOfRays(32)
    room.SetNumberOfWalks(1000000)
    for way, direct_light in (("shot", room.Shot), ("not chosen", room.AutomaticDirectLight)):
        room.SetDirectLight(direct_light)
        first, later, squares = [], [], {ROOM: [], BALL: []}
        for seed in range(1, seeds + 1):
            room.SetSeed(seed)
            first.append(seconds_of_update(room))
            for number in squares:
                squares[number].append(np.mean((surface_of(room, number) - truth[number]) ** 2))
            room.GetDynamicTransform(0).Translate(0.02, 0, 0)
            later.append(seconds_of_update(room))
            room.GetDynamicTransform(0).Translate(-0.02, 0, 0)
        row = f"{name}, {way}"
        report("Defaults", row, "first frame, CPU time, s", np.median(first))
        report("Defaults", row, "after a motion, CPU time, s", np.median(later))
        for number, cells in ((ROOM, "walls"), (BALL, "ball")):
            error = np.sqrt(np.mean(squares[number])) / truth[number].mean()
            report("Defaults", row, f"RMS error on the {cells}, %", 100 * error)


def measure_all(seeds):
    floor = make_filter(make_floor())
    measure("Penumbra", "8 x 8 cells", floor, truth_of(floor), {"in the penumbra": penumbra_of(make_floor())},
            seeds, 0.05, (0.25, 0.15))
    room = make_filter(LitRoom.make_room())
    penumbra = penumbra_of(LitRoom.make_room())
    for reflectance in (0.2, 0.5, 0.8):
        room.SetDefaultDiffuseReflectance(reflectance)
        measure("DirectLight", f"room, reflectance {reflectance}", room, truth_of(room),
                {"in the penumbra": penumbra, "elsewhere": ~penumbra}, seeds, 0.25)
    room.SetDefaultDiffuseReflectance(0.5)
    measure_ways(room, seeds)
    for reflectance in (0.2, 0.5, 0.8):
        room = make_filter(LitRoom.make_room())
        room.SetDefaultDiffuseReflectance(reflectance)
        measure_defaults(f"room, reflectance {reflectance}", room, seeds)


def draw(name, reflectance, ways, seconds=None):
    """In the same colours, two in a row. Without a time: in that of all cells that gather."""
    from vtkmodules.vtkFiltersCore import vtkImageAppend
    from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

    irradiance = make_filter(LitRoom.make_room())
    irradiance.SetDefaultDiffuseReflectance(reflectance)
    executed(irradiance, "gathered", 4000000, 9)
    brightest = surface_of(irradiance).max()
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
    measure_all(int(seeds))
    if four and os.environ.get("DISPLAY"):
        draw(two, 0.2, WAYS, 0.05)
        draw(four, 0.5, ALL_WAYS)


if __name__ == "__main__":
    main(*sys.argv[1:])
