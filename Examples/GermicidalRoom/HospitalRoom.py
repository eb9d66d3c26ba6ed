# SPDX-License-Identifier: BSD-3-Clause
"""The room, what stands in it, and its lamps. x along the room, y across, z up; metres. Reflectances are of 254 nm."""
import math

import numpy as np
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkCapsuleSource, vtkCylinderSource, vtkPlaneSource, vtkSphereSource

import vtkIrradiance

LENGTH, WIDTH, HEIGHT = 6, 4, 2.7
PAINT = PLASTIC = 0.05  # "a typical paint or plastic material will absorb about 95 %" (Lumacept)
STEEL = 0.3
SKIN = 0.05
TUBE_POWER, TUBE_LENGTH, TUBE_RADIUS, TUBE_MIDDLE = 30, 1.0, 0.02, 1.3  # W of UV-C, m, m, m above the floor
UPPER_POWER, UPPER_SIZE = 6, (0.6, 0.08)  # W of UV-C that leave the tray of the lamp upwards; m
SECONDS = 600
# s, m, m: the robot comes in, stops beside the door, at the foot of bed A, and between bed A and the curtain.
TOUR = [(0, 1.2, 0.7), (60, 1.2, 0.7), (90, 2.1, 1.1), (210, 2.1, 1.1), (250, 2.4, 2.8), (450, 2.4, 2.8),
        (500, 2.1, 1.1), (560, 1.2, 0.7), (600, 1.2, 0.7)]
# s, factor: the lamp of the upper air is switched off while the robot is at work.
UPPER_FACTOR = [(0, 1), (60, 1), (90, 0), (500, 0), (530, 1), (600, 1)]
FACE = (3.62, 2.75, 1.2)  # of the person


def named(mesh, name):
    """What its block is called in the output."""
    return with_text(mesh, "Name", name)


def with_text(mesh, array_name, text):
    array = vtkStringArray()
    array.SetName(array_name)
    array.InsertNextValue(text)
    mesh.GetFieldData().AddArray(array)
    return mesh


def join(meshes):
    append = vtkAppendPolyData()
    for mesh in meshes:
        append.AddInputData(mesh)
    append.Update()
    return append.GetOutput()


def reflecting(mesh, reflectance):
    mesh.GetPointData().Initialize()
    vtkIrradiance.add_cell_array(mesh, "DiffuseReflectance", reflectance)
    return mesh


def sheet(origin, u, v, cell, reflectance):
    """A rectangle whose front faces u x v."""
    origin, u, v = (np.array(vector, float) for vector in (origin, u, v))
    plane = vtkPlaneSource()
    plane.SetOrigin(*origin)
    plane.SetPoint1(*(origin + u))
    plane.SetPoint2(*(origin + v))
    plane.SetResolution(*(max(1, round(np.linalg.norm(edge) / cell)) for edge in (u, v)))
    plane.Update()
    return reflecting(plane.GetOutput(), reflectance)


def box(low, high, cell, reflectances, inward=False):
    """`reflectances`: of -x, +x, -y, +y, -z, +z. Its front is outside, unless `inward`."""
    low, high = np.array(low, float), np.array(high, float)
    faces = []
    for side, reflectance in enumerate(reflectances):
        axis, is_high = divmod(side, 2)
        edges = [np.zeros(3), np.zeros(3)]
        for edge, direction in zip(edges, ((axis + 1) % 3, (axis + 2) % 3)):
            edge[direction] = high[direction] - low[direction]
        if bool(is_high) == inward:
            edges.reverse()
        origin = low.copy()
        origin[axis] = high[axis] if is_high else low[axis]
        faces.append(sheet(origin, *edges, cell, reflectance))
    clean = vtkCleanPolyData()  # faces share the points of their edges: no light gets between
    clean.SetInputData(join(faces))
    clean.Update()
    return clean.GetOutput()


def slab(low, size, cell=1, reflectance=PLASTIC):
    return box(low, np.add(low, size), cell, [reflectance] * 6)


def moved(source, translation=(0, 0, 0), turn_x=0, scale=(1, 1, 1)):
    pose = vtkTransform()
    pose.Translate(*translation)
    pose.RotateX(turn_x)
    pose.Scale(*scale)
    transform = vtkTransformPolyDataFilter()
    transform.SetInputConnection(source.GetOutputPort())
    transform.SetTransform(pose)
    transform.Update()
    return transform.GetOutput()


def make_bed(x, cell, name):
    """Its head is at the wall y = WIDTH."""
    return named(join([slab((x - 0.45, 1.9, 0.4), (0.9, 2, 0.15), cell),
                       slab((x - 0.4, 2.0, 0), (0.8, 1.8, 0.3), 0.5, STEEL)]), name)


def make_person():
    """Sits between the curtain and bed B and looks at the curtain. Face and body: the face has a dose of its own."""
    x, y, z = FACE
    torso = vtkCapsuleSource()
    torso.SetRadius(0.17)
    torso.SetCylinderLength(0.35)
    torso.SetThetaResolution(16)
    torso.SetPhiResolution(12)
    head = vtkSphereSource()
    head.SetRadius(0.11)
    head.SetThetaResolution(24)
    head.SetPhiResolution(18)
    ball = moved(head, (x + 0.11, y, z))
    corners = np.array([[ball.GetPoint(ball.GetCell(i).GetPointId(k)) for k in range(3)]
                        for i in range(ball.GetNumberOfCells())])
    middles = corners.mean(axis=1) - (x + 0.11, y, z)
    is_face = (middles[:, 0] < -0.05) & (abs(middles[:, 2]) < 0.09)
    vtkIrradiance.add_cell_array(ball, "IsFace", is_face.astype(float))
    face, skull = (reflecting(cells_with(ball, "IsFace", value), SKIN) for value in (1, 0))
    body = [reflecting(moved(torso, (x + 0.14, y, 0.78), 90), PLASTIC), skull,
            slab((x - 0.3, y - 0.17, 0.42), (0.42, 0.34, 0.14), 0.1),
            slab((x - 0.06, y - 0.2, 0), (0.4, 0.4, 0.4), 0.2)]
    return named(face, "face"), named(join(body), "person")


def cells_with(mesh, array, value):
    threshold = vtkThreshold()
    threshold.SetInputData(mesh)
    threshold.SetInputArrayToProcess(0, 0, 0, 1, array)
    threshold.SetLowerThreshold(value)
    threshold.SetUpperThreshold(value)
    surface = vtkGeometryFilter()
    surface.SetInputConnection(threshold.GetOutputPort())
    surface.Update()
    cells = vtkPolyData()
    cells.SetPoints(surface.GetOutput().GetPoints())
    cells.SetPolys(surface.GetOutput().GetPolys())
    return cells


def make_curtain(cell, transmittance):
    """A film that lets a third of what passes go straight on, and scatters the rest."""
    film = sheet((3, 1.5, 0.3), (0, 2.5, 0), (0, 0, 1.9), cell, 0.1)
    vtkIrradiance.add_cell_array(film, "SpecularTransmittance", transmittance / 3)
    vtkIrradiance.add_cell_array(film, "DiffuseTransmittance", 2 * transmittance / 3)
    return named(film, "curtain")


def make_robot():
    """With its foot in the origin."""
    tube = vtkCylinderSource()
    tube.SetRadius(TUBE_RADIUS)
    tube.SetHeight(TUBE_LENGTH)
    tube.SetResolution(16)
    tube.CappingOff()
    light = reflecting(moved(tube, (0, 0, TUBE_MIDDLE), 90), PLASTIC)
    vtkIrradiance.add_cell_array(
        light, "RadiantExitance", TUBE_POWER / (32 * TUBE_RADIUS * math.sin(math.pi / 16) * TUBE_LENGTH))
    ends = [slab((-0.03, -0.03, TUBE_MIDDLE + side * TUBE_LENGTH / 2 - (0.04 if side < 0 else 0)), (0.06, 0.06, 0.04))
            for side in (-1, 1)]
    stand = join([slab((-0.22, -0.22, 0.05), (0.44, 0.44, 0.6), 0.11), *ends])
    vtkIrradiance.add_cell_array(stand, "RadiantExitance", 0)
    robot = with_text(join([light, stand]), "LightGroup", "robot")
    pose = vtkIrradiance.vtkKeyFramedPose()
    pose.SetInputData(named(robot, "robot"))
    for time, x, y in TOUR:
        pose.AddPose(time, x, y, 0, 0, 0, 0)
    return pose


class Schedule(VTKPythonAlgorithmBase):
    """Lamps of a light group whose factor changes over time: `keys` of seconds and factors, linear between them."""

    def __init__(self, lamps, group, keys):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.lamps, self.keys = with_text(lamps, "LightGroup", group), np.array(keys, float)

    def RequestInformation(self, request, inputs, outputs):
        outputs.GetInformationObject(0).Set(Pipeline.TIME_RANGE(), (self.keys[0, 0], self.keys[-1, 0]), 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        time = information.Get(Pipeline.UPDATE_TIME_STEP()) if information.Has(Pipeline.UPDATE_TIME_STEP()) else 0
        output = vtkPolyData.GetData(outputs)
        output.ShallowCopy(self.lamps)
        factor = vtkDoubleArray()
        factor.SetName("LightGroupFactor")
        factor.InsertNextValue(np.interp(time, *self.keys.T))
        output.GetFieldData().AddArray(factor)
        return 1


def make_upper_lamp():
    """A lamp for the upper air: it shines up out of a tray, whose sides hide it from who is in the room."""
    length, width = UPPER_SIZE
    low = np.array((4.6 - length / 2, WIDTH - 0.06 - width, 2.2))  # above the head of bed B
    lamp = sheet(low, (length, 0, 0), (0, width, 0), 0.1, PLASTIC)
    vtkIrradiance.add_cell_array(lamp, "RadiantExitance", UPPER_POWER / (length * width))
    tray = [slab(low - (0.02, 0.02, 0.03), (length + 0.04, width + 0.04, 0.02)),
            *(slab(low + (x, -0.02, -0.01), (0.01, width + 0.04, 0.09)) for x in (-0.02, length + 0.01)),
            *(slab(low + (-0.01, y, -0.01), (length + 0.02, 0.01, 0.09)) for y in (-0.02, width + 0.01))]
    tray = join(tray)
    vtkIrradiance.add_cell_array(tray, "RadiantExitance", 0)
    return Schedule(named(join([lamp, tray]), "upper lamp"), "upper", UPPER_FACTOR)


def make_light(options):
    """The filter with the whole room."""
    room = box((0, 0, 0), (LENGTH, WIDTH, HEIGHT), options.cell, [PAINT] * 5 + [options.ceiling], inward=True)
    table = join([slab((0.25, 2.1, 0.72), (0.5, 0.4, 0.03), options.cell),
                  slab((0.45, 2.25, 0), (0.1, 0.1, 0.7), 1, STEEL)])
    handle = named(slab((0.55, 0.04, 1.03), (0.14, 0.04, 0.03), 0.02, STEEL), "door handle")
    irradiance = vtkIrradiance.vtkIrradianceFilter()
    for mesh in (named(room, "room"), make_bed(1.4, options.cell, "bed A"), make_bed(4.6, options.cell, "bed B"),
                 named(table, "table"), handle, *make_person(), make_curtain(options.cell, options.film)):
        irradiance.AddInputDataObject(0, mesh)
    irradiance.lamp = make_upper_lamp()  # Python's own algorithms end with their last reference
    irradiance.AddInputConnection(0, irradiance.lamp.GetOutputPort())
    robot = make_robot()
    irradiance.AddInputConnection(1, robot.GetOutputPort())
    irradiance.SetNumberOfWalks(options.walks)
    irradiance.SeparateSidesOn()
    irradiance.ComputeLightGroupsOn()
    return irradiance
