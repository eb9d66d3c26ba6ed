# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong is said where ParaView's user reads it, by name; and what was wrong can be set right."""
import unittest

import plugin


class Errors(unittest.TestCase):
    def check(self, source, words, time=0.0):
        """One error with all these words; the output is empty."""
        messages = plugin.messages_of(lambda: source.SMProxy.UpdatePipeline(time))
        for word in words:
            self.assertIn(word, messages)
        self.assertEqual(plugin.servermanager.Fetch(source).GetNumberOfPoints(), 0)

    def expect_light(self, source, time=0.0):
        self.assertEqual(plugin.messages_of(lambda: source.SMProxy.UpdatePipeline(time)), "")
        self.assertGreater(plugin.figure(source, "EmittedPower"), 0)

    def test_values_out_of_range(self):
        source = plugin.make_scene()
        for name, bad, good in (("NumberOfWalks", 0, 1000), ("DefaultDiffuseReflectance", 1.5, 0.5),
                                ("NumberOfReplicates", 1, 16), ("TargetRelativeError", -1, 0),
                                ("RepairTimeBudget", -0.5, 0)):
            with self.subTest(name):
                setattr(source, name, bad)
                self.check(source, [name, "possible" if bad != -1 else "positive"])
                setattr(source, name, good)
                self.expect_light(source)

    def test_an_array_that_is_not_there(self):
        source = plugin.make_scene(NumberOfWalks=1000, DiffuseReflectanceArray="Paint")
        self.check(source, ["Paint", "diffuse reflectance"])
        source.DiffuseReflectanceArray = "None"
        self.expect_light(source)

    def test_poses(self):
        for poses, words in (([], ["two"]), ([0, 0, 0, 1, 0, 0, 0], ["two"]),
                             ([0, 0, 0, 1, 0, 0, 0, 1, float("nan"), 0, 1, 0, 0, 0], ["pose"])):
            with self.subTest(poses):
                pose = plugin.make_pose(FileName="", Poses=poses)
                self.check(pose, words)
                pose.Poses = [0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0]
                self.assertEqual(plugin.messages_of(lambda: pose.SMProxy.UpdatePipeline(0.5)), "")

    def test_a_time_outside_of_the_keys(self):
        pose = plugin.make_pose()
        self.check(pose, ["OutsideOfKeys", "3"], 3.0)
        pose.OutsideOfKeys = "Hold"
        self.assertEqual(plugin.messages_of(lambda: pose.SMProxy.UpdatePipeline(3.0)), "")

    def test_a_file_of_poses_that_is_not_there(self):
        self.check(plugin.make_pose(FileName="/nowhere.csv"), ["/nowhere.csv"])

    def test_a_matrix_that_is_singular(self):
        part = plugin.XMLPolyDataReader(FileName=[f"{plugin.FOLDER}/part.vtp"])
        self.check(plugin.make_scene(Dynamic=[part], DynamicMatrices=[0] * 15 + [1]), ["connection 0"])

    def test_two_blocks_of_text_tell_an_error(self):
        """Ours, and VTK's own that the filter failed; no more if it is shown as well."""
        source = plugin.make_scene(DiffuseReflectanceArray="Paint")
        view = plugin.paraview.simple.GetActiveViewOrCreate("RenderView")
        self.addCleanup(plugin.paraview.simple.Delete, view)

        def look():
            plugin.paraview.simple.Show(source, view)
            plugin.paraview.simple.Render(view)

        messages = plugin.messages_of(look)
        self.assertEqual(messages.count("Paint"), 1)
        self.assertEqual(messages.count("returned failure"), 1)
        self.assertEqual(messages.count("ERROR: "), 2)

    def test_photons_do_not_come_from_files(self):
        room = plugin.XMLMultiBlockDataReader(FileName=[f"{plugin.FOLDER}/irradiance-0.vtm"])
        self.check(plugin.paraview.simple.OutgoingRadiance(Input=room), ["vtkIrradianceFilter", "photons"])


if __name__ == "__main__":
    unittest.main()
