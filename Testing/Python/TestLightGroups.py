# SPDX-License-Identifier: BSD-3-Clause
"""Light groups: a dict dims them, and the output has the parts."""
import unittest

import numpy as np
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject

import vtkIrradiance
from scenes import make_filter, output_bits


def parts(irradiance, group):
    return [np.asarray(array) for array in WrapDataObject(irradiance.GetOutput()).CellData["Irradiance_" + group].Arrays]


class LightGroups(unittest.TestCase):
    def test_a_dict_dims_groups(self):
        irradiance = make_filter()  # its lamp is static, and nobody named its group
        irradiance.ComputeLightGroupsOn()
        vtkIrradiance.update(irradiance)
        full, whole = parts(irradiance, "Static"), output_bits(irradiance)
        self.assertGreater(full[1].sum(), 0)
        self.assertEqual([part.tobytes() for part in full], whole)
        vtkIrradiance.set_light_group_factors(irradiance, {"Static": 0.25})
        vtkIrradiance.update(irradiance)
        for now, then in zip(parts(irradiance, "Static"), full):
            np.testing.assert_array_equal(now, 0.25 * then)  # a power of two changes no digit
        vtkIrradiance.set_light_group_factors(irradiance, {})
        vtkIrradiance.update(irradiance)
        self.assertEqual(output_bits(irradiance), whole)

    def test_one_number_or_three(self):
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        vtkIrradiance.set_light_group_factors(irradiance, {"tube": 0.5, "ceiling": (1, 0.8, 0.6), 7: np.array([2, 3, 4])})
        self.assertEqual([irradiance.GetLightGroupFactor("tube", band) for band in range(3)], [0.5] * 3)
        self.assertEqual([irradiance.GetLightGroupFactor("ceiling", band) for band in range(3)], [1, 0.8, 0.6])
        self.assertEqual(irradiance.GetLightGroupFactor("7", 2), 4)

    def test_anything_else_is_an_error_and_changes_nothing(self):
        irradiance = vtkIrradiance.vtkIrradianceFilter()
        vtkIrradiance.set_light_group_factors(irradiance, {"tube": 0.5})
        for factor in (-1, float("nan"), float("inf"), (1, 2), "bright"):
            with self.assertRaises(ValueError):
                vtkIrradiance.set_light_group_factors(irradiance, {"ceiling": 2, "tube": factor})
        self.assertEqual(irradiance.GetLightGroupFactor("tube"), 0.5)
        self.assertEqual(irradiance.GetLightGroupFactor("ceiling"), 1)
