# SPDX-License-Identifier: BSD-3-Clause
"""The plugin and the C++ filter have the same numbers, bit for bit, at any time and in any order of times."""
import unittest

from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader

import plugin


def expected(time):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(f"{plugin.FOLDER}/irradiance-{time}.vtm")
    reader.Update()
    return plugin.bits(reader.GetOutput())


# What the way to a state costs is not the state's.
COSTS = ("NumberOfInvalidWalks", "NumberOfRepairedSegments", "HistoryBytes")


class SameBits(unittest.TestCase):
    def check(self, source, time):
        ours, theirs = plugin.bits(plugin.fetch(source, float(time))), expected(time)
        self.assertIn("0 Irradiance", theirs)
        self.assertIn("1 IrradianceStandardError", theirs)
        self.assertTrue(theirs["1 Irradiance"].strip(b"\0"), "the part is dark")
        self.assertEqual(sorted(ours), sorted(theirs))
        for name in theirs:
            if name not in COSTS:
                self.assertEqual(ours[name], theirs[name], f"time {time}, {name}")

    def test_forwards_and_backwards(self):
        source = plugin.make_scene()
        source.UpdatePipelineInformation()
        self.assertEqual(list(source.TimestepValues), plugin.STEPS)
        for time in plugin.TIMES + plugin.TIMES[::-1]:
            self.check(source, time)
        self.assertGreater(plugin.figure(source, "NumberOfRepairedSegments"), 0)

    def test_poses_of_the_panel(self):
        poses = [0, -1.2, 0, 0.4, 0, 0, 0, 1, 0, 0.3, 0.9, 20, 10, 80, 2, 1.3, -0.2, 0.4, 0, 0, 120]
        self.check(plugin.make_scene(Dynamic=[plugin.make_pose(FileName="", Poses=poses)]), "1.7")

    def test_matrices_of_the_panel(self):
        part = plugin.XMLPolyDataReader(FileName=[f"{plugin.FOLDER}/part.vtp"])
        source = plugin.make_scene(
            Dynamic=[part], DynamicMatrices=[1, 0, 0, -1.2, 0, 1, 0, 0, 0, 0, 1, 0.4, 0, 0, 0, 1])
        self.check(source, "0")


if __name__ == "__main__":
    unittest.main()
