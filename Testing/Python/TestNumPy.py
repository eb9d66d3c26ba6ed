# SPDX-License-Identifier: BSD-3-Clause
"""Arrays go in and out as NumPy's, the ways that VTK documents, and are shared, not copied."""
import unittest

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource

import vtkIrradiance
from scenes import address, field, irradiances, make_filter, make_lamp, output_bits


def numpy_address(array):
    return array.__array_interface__["data"][0]


class NumPyIn(unittest.TestCase):
    def test_exitance_is_shared(self):
        exitance = np.array([100.0])
        lamp = make_lamp(exitance)
        array = lamp.GetCellData().GetArray("RadiantExitance")
        self.assertEqual(address(array), numpy_address(exitance))
        irradiance = make_filter()
        irradiance.RemoveAllInputConnections(0)
        irradiance.AddInputDataObject(0, lamp)
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 100, 9)  # W: 1 m2
        before = [values.copy() for values in irradiances(irradiance)]
        self.assertGreater(before[1].sum(), 0)

        # VTK does not see when NumPy writes; Modified() says so.
        exitance[0] = 200
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 100, 9)
        array.Modified()
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 200, 9)
        # A power of two changes no digit.
        for now, then in zip(irradiances(irradiance), before):
            np.testing.assert_array_equal(now, 2 * then)

    def test_kinds_of_numbers_give_the_same_light(self):
        outputs = []
        for kind in (np.float64, np.float32, np.int32, np.uint8):
            irradiance = make_filter()
            irradiance.RemoveAllInputConnections(0)
            irradiance.AddInputDataObject(0, make_lamp(np.array([100], kind)))
            vtkIrradiance.update(irradiance)
            outputs.append(output_bits(irradiance))
        self.assertEqual(outputs, outputs[:1] * 4)

    def test_meshes_are_shared_and_deform(self):
        points = np.array([[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]], float)
        corners = np.array([0, 1, 2, 0, 2, 3])
        vtk_points = vtkPoints()
        vtk_points.SetData(numpy_to_vtk(points))
        cells = vtkCellArray()
        cells.SetData(3, numpy_to_vtkIdTypeArray(corners))
        mesh = vtkPolyData()
        mesh.SetPoints(vtk_points)
        mesh.SetPolys(cells)
        WrapDataObject(mesh).CellData.append(np.array([10.0, 20.0]), "RadiantExitance")
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        irradiance.SetNumberOfWalks(1000)
        irradiance.AddInputDataObject(1, mesh)
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 3 * 10 + 3 * 20, 9)  # W: 3 m2 each
        points[:, 1] *= 2
        vtk_points.GetData().Modified()
        vtk_points.Modified()
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 6 * 10 + 6 * 20, 9)

    def test_bands_are_columns(self):
        irradiance = make_filter()
        irradiance.RemoveAllInputConnections(0)
        irradiance.AddInputDataObject(0, make_lamp(np.array([[100.0, 0.0, 25.0]])))
        vtkIrradiance.update(irradiance)
        ball = irradiances(irradiance)[1]
        self.assertEqual(ball.shape[1], 3)
        np.testing.assert_array_equal(ball[:, 1], 0)
        self.assertGreater(ball[:, 0].sum(), 0)

    def test_bad_arrays_are_one_clear_error_each(self):
        for exitance, words in ((np.array([-1.0]), "radiant exitance -1 W/m2"),
                                (np.array([np.nan]), "radiant exitance nan W/m2"),
                                (np.array([[1.0, 2.0]]), "RadiantExitance"),
                                (np.array([1.0, 2.0]), "RadiantExitance")):
            irradiance = make_filter()
            irradiance.RemoveAllInputConnections(0)
            irradiance.AddInputDataObject(0, make_lamp(exitance))
            with self.assertRaises(RuntimeError) as caught:
                vtkIrradiance.update(irradiance)
            self.assertIn(words, str(caught.exception))
            self.assertIn("input port 0, connection 0", str(caught.exception))
            self.assertEqual(irradiance.GetOutput().GetNumberOfBlocks(), 0)


    def test_arrays_of_another_length_are_told_apart(self):
        plane = vtkPlaneSource()
        plane.SetResolution(3, 3)
        plane.Update()
        for values, words in ((np.arange(5.0), r"5 components; 1 or 3 .* \(9,\) or \(9, 3\).*append\(\) repeats"),
                              (np.ones((3, 9)), r"27 components; 1 or 3 .* \(9,\) or \(9, 3\)")):
            WrapDataObject(plane.GetOutput()).CellData.append(values, "RadiantExitance")
            irradiance = make_filter()
            irradiance.AddInputDataObject(0, plane.GetOutput())
            with self.assertRaisesRegex(RuntimeError, "input port 0, connection 1: .*RadiantExitance.*" + words):
                vtkIrradiance.update(irradiance)

    def test_a_mesh_that_is_no_polydata(self):
        irradiance = make_filter()
        irradiance.AddInputDataObject(1, vtkUnstructuredGrid())
        with self.assertRaisesRegex(RuntimeError, "input port 1, connection 1 .*vtkUnstructuredGrid.*vtkGeometryFilter"):
            vtkIrradiance.update(irradiance)


class AddCellArray(unittest.TestCase):
    def setUp(self):
        plane = vtkPlaneSource()
        plane.SetResolution(3, 3)
        plane.Update()
        self.plane = plane.GetOutput()

    def added(self, values):
        vtkIrradiance.add_cell_array(self.plane, "RadiantExitance", values)
        return vtk_to_numpy(self.plane.GetCellData().GetArray("RadiantExitance"))

    def test_one_value_one_for_each_cell_or_three(self):
        np.testing.assert_array_equal(self.added(7), [7] * 9)
        np.testing.assert_array_equal(self.added(range(9)), range(9))
        np.testing.assert_array_equal(self.added([[1, 2, 3]] * 9), [[1, 2, 3]] * 9)
        self.assertEqual(self.plane.GetCellData().GetNumberOfArrays(), 1)

    def test_numpy_arrays_are_shared(self):
        for values in (np.arange(9.0), np.arange(27.0).reshape(9, 3)):
            self.assertEqual(numpy_address(self.added(values)), numpy_address(values))
            np.testing.assert_array_equal(self.added(values), values)
        np.testing.assert_array_equal(self.added(np.arange(18)[::2]), np.arange(0, 18, 2))

    def test_any_other_shape_is_an_error(self):
        for values, shape in ((np.arange(5), r"\(5,\)"), ([1, 2, 3], r"\(3,\)"), (np.ones((3, 9)), r"\(3, 9\)"),
                              (np.ones((9, 2)), r"\(9, 2\)"), ([], r"\(0,\)")):
            with self.assertRaisesRegex(ValueError, f"RadiantExitance: .*{shape} for 9 cells.*\\(9,\\).*\\(9, 3\\)"):
                self.added(values)
        with self.assertRaisesRegex(ValueError, "a row of 2 values"):
            self.added([[1, 2, 3]] * 8 + [[1, 2]])
        self.assertEqual(self.plane.GetCellData().GetNumberOfArrays(), 0)

    def test_the_light_is_the_same(self):
        vtkIrradiance.add_cell_array(self.plane, "RadiantExitance", [float(i) for i in range(9)])
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        irradiance.SetNumberOfWalks(1000)
        irradiance.AddInputDataObject(0, self.plane)
        vtkIrradiance.update(irradiance)
        self.assertAlmostEqual(field(irradiance, "EmittedPower"), 36 / 9)  # W: 1 m2 in all


class NumPyOut(unittest.TestCase):
    def test_irradiance_is_shared(self):
        irradiance = make_filter()
        vtkIrradiance.update(irradiance)
        iterator = irradiance.GetOutput().NewIterator()
        iterator.GoToNextItem()
        array = iterator.GetCurrentDataObject().GetCellData().GetArray("Irradiance")
        for values in (irradiances(irradiance)[1], vtk_to_numpy(array)):
            self.assertEqual(numpy_address(np.asarray(values)), address(array))
            values[0] += 1
            self.assertEqual(values[0], array.GetValue(0))
        self.assertEqual(values.dtype, np.float64)
        self.assertEqual(len(values), array.GetNumberOfTuples())

    def test_values_outlive_the_update_and_the_filter(self):
        irradiance = make_filter()
        vtkIrradiance.update(irradiance)
        values = irradiances(irradiance)
        kept = output_bits(irradiance)
        irradiance.GetDynamicTransform(0).Translate(0, 0, 1)
        vtkIrradiance.update(irradiance)
        self.assertNotEqual(output_bits(irradiance), kept)
        del irradiance
        self.assertEqual([array.tobytes() for array in values], kept)
