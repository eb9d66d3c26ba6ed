# SPDX-License-Identifier: BSD-3-Clause
"""vtkIrradiance.update(): errors are exceptions, warnings are Python's, progress is reported, Ctrl-C stops it without harm."""
import signal
import subprocess
import sys
import threading
import unittest
import warnings

import numpy as np
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import vtkIrradiance
from scenes import make_filter, output_bits

# Seconds of walks, of which nothing is stored: the scene is static.
LONG_RUN = """
import signal, sys
import vtkIrradiance
from scenes import make_filter, output_bits

signal.alarm(20)  # the whole run would take half an hour
irradiance = make_filter(walks=4294967295)
irradiance.SetDirectLightToShot()  # a lamp alone has nothing to gather
irradiance.RemoveAllInputConnections(1)
irradiance.RemoveAllDynamicTransforms()
shown = []

def progress(part, fraction):
    if part is irradiance and fraction > 0 and not shown:
        shown.append(fraction)
        print("runs", flush=True)

try:
    vtkIrradiance.update(irradiance, progress)
    sys.exit("was not interrupted")
except KeyboardInterrupt:
    assert irradiance.GetOutput().GetNumberOfBlocks() == 0
assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
irradiance.SetNumberOfWalks(1000)
vtkIrradiance.update(irradiance)
fresh = make_filter(walks=1000)
fresh.RemoveAllInputConnections(1)
fresh.RemoveAllDynamicTransforms()
fresh.Update()
assert output_bits(irradiance) == output_bits(fresh)
print("goes on")
"""


class Pipelines(unittest.TestCase):
    def test_looks_at_each_input_a_few_times_only(self):
        """Comparisons are counted, as those with all others would be the square of the number of inputs."""
        for number in (100, 400):
            comparisons = []

            class Counted(vtkSphereSource):
                def __eq__(self, other):
                    comparisons.append(other)
                    return self is other

                __hash__ = object.__hash__

            sources = [Counted() for _ in range(number)]
            append = vtkAppendPolyData()
            for source in sources:
                append.AddInputConnection(source.GetOutputPort())
            vtkIrradiance.update(append)
            self.assertLess(len(comparisons), 10 * number)


class Errors(unittest.TestCase):
    def test_error_is_raised_and_filter_stays_usable(self):
        irradiance = make_filter()
        irradiance.SetNumberOfWalks(0)
        with self.assertRaisesRegex(RuntimeError, r"^vtkIrradianceFilter: .*\b0\b"):
            vtkIrradiance.update(irradiance)
        self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 0)
        irradiance.SetNumberOfWalks(20000)
        vtkIrradiance.update(irradiance)
        fresh = make_filter()
        fresh.Update()
        self.assertEqual(output_bits(irradiance), output_bits(fresh))

    def test_poses_that_are_no_poses(self):
        for value, words in ((np.nan, "is not finite"), (0, "singular")):
            irradiance = make_filter()
            matrix = irradiance.GetDynamicTransform(0).GetMatrix().NewInstance()
            matrix.SetElement(0, 0, value)
            irradiance.GetDynamicTransform(0).SetMatrix(matrix)
            with self.assertRaisesRegex(RuntimeError, "input port 1, connection 0.*") as caught:
                vtkIrradiance.update(irradiance)
            self.assertIn(words, str(caught.exception))

    def test_error_upstream(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName("/no such file")
        irradiance = make_filter()
        irradiance.AddInputConnection(1, reader.GetOutputPort())
        with self.assertRaisesRegex(RuntimeError, "^vtkXMLPolyDataReader: .*/no such file"):
            vtkIrradiance.update(irradiance)

    def test_observers_are_removed(self):
        irradiance = make_filter()
        vtkIrradiance.update(irradiance)
        for event in ("ProgressEvent", "ErrorEvent", "WarningEvent"):
            self.assertFalse(irradiance.HasObserver(event))
            self.assertFalse(irradiance.GetExecutive().HasObserver(event))


class Warnings(unittest.TestCase):
    def warnings_of(self, algorithm):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            vtkIrradiance.update(algorithm)
        return caught

    def test_a_warning_is_python_s_and_names_the_line(self):
        irradiance = make_filter(exitance=0.0)
        caught = self.warnings_of(irradiance)
        self.assertEqual(len(caught), 1)
        self.assertIs(caught[0].category, vtkIrradiance.PipelineWarning)
        self.assertTrue(issubclass(vtkIrradiance.PipelineWarning, UserWarning))
        self.assertRegex(str(caught[0].message), "^vtkIrradianceFilter: the scene has no light")
        self.assertEqual(caught[0].filename, __file__)
        irradiance.GetDynamicTransform(0).Translate(0, 0, 1)
        self.assertEqual(self.warnings_of(irradiance), [])  # a motion changes nothing about it

    def test_a_warning_upstream_comes_once(self):
        irradiance = make_filter(exitance=0.0)
        surface = vtkCompositeDataGeometryFilter()
        surface.SetInputConnection(irradiance.GetOutputPort())
        twice = vtkAppendPolyData()
        twice.AddInputConnection(surface.GetOutputPort())
        twice.AddInputConnection(surface.GetOutputPort())
        self.assertEqual(len(self.warnings_of(twice)), 1)

    def test_a_warning_can_be_made_an_error(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", vtkIrradiance.PipelineWarning)
            with self.assertRaisesRegex(vtkIrradiance.PipelineWarning, "no light"):
                vtkIrradiance.update(make_filter(exitance=0.0))

    def test_an_error_comes_after_the_warnings(self):
        irradiance = make_filter(exitance=0.0)
        irradiance.SetTargetRelativeError(5)
        with self.assertRaisesRegex(RuntimeError, "5 % is 0.05"):
            self.warnings_of(irradiance)


class Progress(unittest.TestCase):
    def test_goes_from_0_to_1(self):
        irradiance = make_filter()
        reported = []
        vtkIrradiance.update(irradiance, lambda part, fraction: reported.append((part.GetClassName(), fraction)))
        fractions = [fraction for name, fraction in reported if name == "vtkIrradianceFilter"]
        self.assertEqual((fractions[0], fractions[-1]), (0, 1))
        self.assertEqual(fractions, sorted(fractions))
        self.assertIn(("vtkSphereSource", 1), reported)

    def test_exception_stops_the_update(self):
        irradiance = make_filter()

        def progress(part, fraction):
            if part is irradiance:
                raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            vtkIrradiance.update(irradiance, progress)
        self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 0)
        vtkIrradiance.update(irradiance)  # without Modified()
        fresh = make_filter()
        fresh.Update()
        self.assertEqual(output_bits(irradiance), output_bits(fresh))

    def test_in_another_thread(self):
        irradiance = make_filter()
        thread = threading.Thread(target=vtkIrradiance.update, args=(irradiance,))
        thread.start()
        thread.join()
        self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 2)

    def test_time(self):
        sphere = vtkSphereSource()
        vtkIrradiance.update(sphere, time=3.5)
        information = sphere.GetOutputInformation(0)
        self.assertEqual(information.Get(sphere.GetExecutive().UPDATE_TIME_STEP()), 3.5)


class Interrupt(unittest.TestCase):
    def test_ctrl_c_stops_a_long_run(self):
        with subprocess.Popen([sys.executable, "-c", LONG_RUN], stdout=subprocess.PIPE, text=True) as run:
            self.assertEqual(run.stdout.readline(), "runs\n")
            run.send_signal(signal.SIGINT)
            rest, _ = run.communicate()
        self.assertEqual((run.returncode, rest), (0, "goes on\n"))

    def test_ctrl_c_during_an_update_leaves_the_filter_whole(self):
        irradiance = make_filter()
        vtkIrradiance.update(irradiance)
        irradiance.GetDynamicTransform(0).Translate(0, 0.1, 0)

        def interrupt(part, fraction):
            if part is irradiance and fraction > 0:
                signal.raise_signal(signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            vtkIrradiance.update(irradiance, interrupt)
        self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 0)
        vtkIrradiance.update(irradiance)
        fresh = make_filter()
        fresh.GetDynamicTransform(0).Translate(0, 0.1, 0)
        fresh.Update()
        self.assertEqual(output_bits(irradiance), output_bits(fresh))

    def test_own_handlers_are_called(self):
        calls = []
        before = signal.signal(signal.SIGINT, lambda number, frame: calls.append(number))
        try:
            irradiance = make_filter()
            vtkIrradiance.update(irradiance, lambda part, fraction: calls or signal.raise_signal(signal.SIGINT))
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertEqual(calls, [signal.SIGINT])
        self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 2)
