# SPDX-License-Identifier: BSD-3-Clause
"""From the file of a lamp to the irradiance at a point, as the Guide has it: write, read, place, filter, probe."""
import math
import os
import tempfile
import unittest

from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource

import vtkIrradiance

EFFICACY = 250.0  # lm/W
# 1000 cd downwards, and 600 cd at 60 degrees; linear between.
FILE = """IESNA:LM-63-2002
[TEST] none
[MANUFAC] Nobody
TILT=NONE
1 -1 1 3 1 1 2 0 0 0
1 1 10
0 60 90
0
1000 600 0
"""


class Luminaire(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.reader = vtkIrradiance.vtkLuminaireReader()
        self.reader.SetFileName(os.path.join(folder.name, "lamp.ies"))
        with open(self.reader.GetFileName(), "w", encoding="ascii") as file:
            file.write(FILE)
        self.place = vtkTransform()
        self.place.Translate(1, 2, 2)

    def irradiance_below(self):
        """On the floor, 2 m below the lamp."""
        lamp = vtkTransformPolyDataFilter()
        lamp.SetTransform(self.place)
        lamp.SetInputConnection(self.reader.GetOutputPort())
        floor = vtkPlaneSource()
        floor.SetPoint1(4, 0, 0)
        floor.SetPoint2(0, 4, 0)
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        irradiance.SetDefaultDiffuseReflectance(0)
        irradiance.AddInputConnection(0, floor.GetOutputPort())
        irradiance.AddInputConnection(0, lamp.GetOutputPort())
        sensors = vtkPlaneSource()  # the first of its corners is below the lamp
        sensors.SetOrigin(1, 2, 0)
        sensors.SetPoint1(1.1, 2, 0)
        sensors.SetPoint2(1, 2.1, 0)
        probe = vtkIrradiance.vtkIrradianceProbeFilter()
        probe.SetInputConnection(sensors.GetOutputPort())
        probe.SetSourceConnection(irradiance.GetOutputPort())
        vtkIrradiance.update(probe)
        return probe.GetOutput().GetPointData().GetArray("Irradiance").GetTuple1(0)

    def test_candela_become_watts_on_the_floor(self):
        self.reader.SetLuminousEfficacy(EFFICACY)
        self.assertAlmostEqual(self.irradiance_below(), 1000 / EFFICACY / 2**2, delta=0.01)
        self.place.RotateX(60)
        self.assertAlmostEqual(self.irradiance_below(), 600 / EFFICACY / 2**2, delta=0.01)
        self.place.RotateX(60)
        self.assertEqual(self.irradiance_below(), 0)

    def test_field_data_tell_the_flux_and_the_maker(self):
        self.reader.SetLuminousEfficacy(EFFICACY)
        vtkIrradiance.update(self.reader)
        fields = self.reader.GetOutput().GetFieldData()
        self.assertEqual(fields.GetAbstractArray("Manufacturer").GetValue(0), "Nobody")
        steps, flux = 100000, 0
        for i in range(steps):
            angle = (i + 0.5) / steps * math.pi / 2
            degrees = math.degrees(angle)
            candela = 1000 - 400 * degrees / 60 if degrees < 60 else 20 * (90 - degrees)
            flux += candela * 2 * math.pi * math.sin(angle) * math.pi / 2 / steps
        self.assertAlmostEqual(fields.GetArray("Flux").GetTuple1(0), flux / EFFICACY, delta=1e-6)

    def test_an_error_tells_what_is_missing(self):
        with self.assertRaisesRegex(RuntimeError, "LuminousEfficacy"):
            vtkIrradiance.update(self.reader)
