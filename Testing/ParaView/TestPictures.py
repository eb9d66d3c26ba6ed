# SPDX-License-Identifier: BSD-3-Clause
"""A scene that moves, as ParaView shows it."""
import os
import unittest

from paraview.simple import ColorBy, Delete, GetActiveViewOrCreate, GetAnimationScene, SaveScreenshot, Show

import pictures
import plugin


class Pictures(unittest.TestCase):
    def test_an_animation(self):
        source = plugin.make_scene()
        view = GetActiveViewOrCreate("RenderView")
        self.addCleanup(Delete, view)  # it must not outlive the window system
        view.ViewSize = [300, 300]
        view.OrientationAxesVisibility = 0
        display = Show(source, view)
        ColorBy(display, ("CELLS", "Irradiance"))
        display.SetScalarBarVisibility(view, False)
        display.LookupTable.RescaleTransferFunction(0, 12)
        display.BackfaceRepresentation = "Cull Frontface"
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1.95, 1.6], [0, 0, 1], [0, 0, 1]
        view.CameraViewAngle = 75
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(list(scene.TimeKeeper.TimestepValues), [0, 1, 2])
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
