# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that have to look alike."""
import os

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkImagingCore import vtkImageDifference


def read(file_name):
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    reader.Update()
    return reader.GetOutput()


def difference(picture, baseline):
    """VTK's measure. By default it forgives so much of every pixel that a red wall passes for a green one."""
    compared = vtkImageDifference()
    compared.SetThreshold(16)
    compared.SetInputData(read(picture))
    compared.SetImageData(read(baseline))
    compared.Update()
    return compared.GetThresholdedError()


def check(test, picture, baseline, threshold=10):
    """Fails if a picture differs from its baseline by more than other machines' fonts and rounding do."""
    test.assertTrue(os.path.exists(picture), f"{picture} was not made")
    test.assertTrue(os.path.exists(baseline), f"{baseline} is missing; look at {picture} and copy it there")
    test.assertEqual(*(read(name).GetDimensions() for name in (picture, baseline)))
    test.assertLess(difference(picture, baseline), threshold, f"{picture} is not like {baseline}")
