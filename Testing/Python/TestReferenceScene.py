# SPDX-License-Identifier: BSD-3-Clause
"""Python and C++ have the same numbers, bit for bit, in the scene that ParaView is compared in, too."""
import os
import subprocess
import tempfile
import unittest

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import same_bits
import vtkIrradiance


def read(folder, name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(f"{folder}/{name}.vtp")
    return reader


class ReferenceScene(unittest.TestCase):
    def test_same_bits_at_all_times(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["REFERENCE_SCENE"], folder], check=True)
            room, part = read(folder, "room"), read(folder, "part")
            pose = vtkIrradiance.vtkKeyFramedPose()
            pose.SetInputConnection(part.GetOutputPort())
            pose.SetFileName(f"{folder}/poses.csv")
            irradiance = vtkIrradiance.vtkIrradianceFilter()
            irradiance.AddInputConnection(0, room.GetOutputPort())
            irradiance.AddInputConnection(1, pose.GetOutputPort())
            irradiance.SetNumberOfWalks(100000)
            irradiance.ComputeStandardErrorOn()
            for time in ("0", "0.375", "1", "1.7", "2"):
                vtkIrradiance.update(irradiance, time=float(time))
                ours = same_bits.contents(irradiance.GetOutput())
                theirs = same_bits.contents(same_bits.read(f"{folder}/irradiance-{time}.vtm"))
                theirs.pop("field data TimeValue")  # the writer's own
                self.assertTrue(any(name.endswith("IrradianceStandardError") for name in theirs))
                self.assertEqual(sorted(ours), sorted(theirs))
                for name in theirs:
                    self.assertTrue(ours[name] == theirs[name], f"time {time}, {name}")
