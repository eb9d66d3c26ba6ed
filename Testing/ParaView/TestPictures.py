# SPDX-License-Identifier: BSD-3-Clause
"""A scene that moves, as ParaView shows it."""
import os
import unittest

from paraview.simple import Delete, GetAnimationScene, SaveScreenshot

import pictures
import plugin


class Pictures(unittest.TestCase):
    def test_an_animation(self):
        source = plugin.make_scene()
        view = plugin.show(source, 300)
        self.addCleanup(Delete, view)  # it must not outlive the window system
        view.CameraViewAngle = 75
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(list(scene.TimeKeeper.TimestepValues), plugin.STEPS)
        self.assertEqual(scene.PlayMode, "Snap To TimeSteps")
        made = []
        for time in (2, 1):
            scene.AnimationTime = time
            file_name = f"Room{time}.png"
            picture = os.path.join(plugin.OUTPUT, file_name)
            SaveScreenshot(picture, view, ImageResolution=[300, 300])
            made.append(picture)
            pictures.check(self, picture, os.path.join(os.environ["BASELINE"], file_name))
        self.assertGreater(pictures.difference(*made), 100, "the part does not move")


if __name__ == "__main__":
    unittest.main()
