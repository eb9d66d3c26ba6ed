# SPDX-License-Identifier: BSD-3-Clause
"""All that the public headers offer is there in Python, with its documentation."""
import os
import pathlib
import re
import unittest

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonTransforms import vtkTransform

import vtkIrradiance

HEADERS = sorted((pathlib.Path(__file__).parents[2] / "Modules" / "FiltersIrradiance").glob("vtk*.h"))
MACRO = re.compile(r"^  vtk(Set|Get|Boolean)\w*Macro\((\w+)", re.MULTILINE)
METHOD = re.compile(r"^  (?:virtual )?[\w:]+[*&]? (\w+)\((?![^;{]*\boverride\b)", re.MULTILINE)


def public_part(header):
    text = re.sub(r"//.*", "", re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL))
    return text[text.index("\npublic:"):text.index("\nprotected:")]


def methods(header):
    """The methods that a header declares, in full or through VTK's macros."""
    text = public_part(header)
    for kind, name in MACRO.findall(text):
        yield from (f"{name}On", f"{name}Off") if kind == "Boolean" else (kind + name,)
    yield from METHOD.findall(text)


class Wrapping(unittest.TestCase):
    def test_every_class_and_method_is_there(self):
        self.assertGreaterEqual(len(HEADERS), 3)
        for header in HEADERS:
            wrapped = getattr(vtkIrradiance, header.stem)
            self.assertTrue(issubclass(wrapped, vtkAlgorithm))
            self.assertTrue(wrapped().IsA(header.stem))
            names = set(methods(header))
            self.assertGreaterEqual(len(names), 4, header)
            self.assertEqual({name for name in names if name not in wrapped.__dict__}, set(), header)

    def test_classes_and_properties_are_documented(self):
        for header in HEADERS:
            wrapped = getattr(vtkIrradiance, header.stem)
            self.assertIn(re.search(r"@brief +(\w+ \w+)", header.read_text())[1], wrapped.__doc__)
            for name in set(methods(header)):
                self.assertIn("C++: ", getattr(wrapped, name).__doc__, name)
        self.assertIn("W/m2", vtkIrradiance.vtkIrradianceFilter.__doc__)
        self.assertIn("model to world", vtkIrradiance.vtkIrradianceFilter.SetDynamicTransform.__doc__)

    def test_properties_hold_what_they_are_given(self):
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        irradiance.SetNumberOfWalks(4294967295)
        self.assertEqual(irradiance.GetNumberOfWalks(), 4294967295)
        self.assertEqual(irradiance.GetMethod(), irradiance.Automatic)
        irradiance.SetMethod(irradiance.SpreadWalks)
        self.assertEqual(irradiance.GetMethod(), 2)
        irradiance.SetMethodToPathTraced()
        self.assertEqual(irradiance.GetMethod(), irradiance.PathTraced)
        self.assertIsInstance(irradiance.Gathered, vtkIrradiance.vtkIrradianceFilter.Methods)
        irradiance.SeparateSidesOn()
        self.assertEqual(irradiance.GetSeparateSides(), 1)
        pose = vtkTransform()
        before = irradiance.GetMTime()
        irradiance.SetDynamicTransform(2, pose)
        self.assertIs(irradiance.GetDynamicTransform(2), pose)
        self.assertIsNone(irradiance.GetDynamicTransform(0))
        self.assertGreater(irradiance.GetMTime(), before)
        irradiance.SetDynamicTransform(2, None)
        self.assertIsNone(irradiance.GetDynamicTransform(2))

    def test_arguments_of_the_wrong_kind_are_type_errors(self):
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        for call in (lambda: irradiance.SetDynamicTransform(0, 5),
                     lambda: irradiance.SetDynamicTransform("0", vtkTransform()),
                     lambda: irradiance.SetDynamicTransform(0, irradiance),
                     lambda: irradiance.SetNumberOfWalks("many"),
                     lambda: irradiance.SetSeed()):
            self.assertRaises(TypeError, call)

    def test_version(self):
        version = os.environ["VTKIRRADIANCE_VERSION"]
        self.assertEqual(vtkIrradiance.__version__, version)
        self.assertEqual(vtkIrradiance.VTKIRRADIANCE_VERSION, version)
        self.assertEqual("{}.{}.{}".format(vtkIrradiance.VTKIRRADIANCE_MAJOR_VERSION,
                                           vtkIrradiance.VTKIRRADIANCE_MINOR_VERSION,
                                           vtkIrradiance.VTKIRRADIANCE_PATCH_VERSION), version)
