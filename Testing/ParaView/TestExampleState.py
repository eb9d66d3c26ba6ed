# SPDX-License-Identifier: BSD-3-Clause
"""What LitRoom writes opens in ParaView as in its picture, by the state beside it."""
import os
import subprocess
import unittest

from paraview.simple import Delete, GetActiveView, GetColorTransferFunction, GetScalarBar, SaveScreenshot
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject

import pictures

OUTPUT = os.environ["OUTPUT"]


class ExampleState(unittest.TestCase):
    def test_lit_room_is_open_and_its_lamp_bright(self):
        # Without a display of its own it leaves no picture, which is not needed here.
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        subprocess.run([os.environ["LIT_ROOM"]], cwd=OUTPUT, env=environment, check=True, capture_output=True)
        state = os.path.join(OUTPUT, "LitRoom-output", "ParaViewState.py")
        with open(state, encoding="utf-8") as file:
            exec(compile(file.read(), state, "exec"), {"__name__": "__main__"})  # as ParaView does: no __file__
        view = GetActiveView()
        self.addCleanup(Delete, view)  # it must not outlive the window system
        colours = GetColorTransferFunction("Irradiance")
        self.assertEqual(GetScalarBar(colours, view).Title, "Irradiance (W/m2)")
        # The lamp's 400 W fall on walls of 80 m2, and the ball's top is the brightest: neither it nor the lamp's
        # 100 W/m2 sets the range.
        self.assertGreater(colours.RGBPoints[-4], 400 / 80)
        self.assertLess(colours.RGBPoints[-4], 60)
        picture = os.path.join(OUTPUT, "LitRoom.png")
        SaveScreenshot(picture, view, ImageResolution=[600, 400])
        pixels = WrapDataObject(pictures.read(picture)).PointData[0].reshape(400, 600, -1)[:, :, :3]
        lamp = pixels[302:312, 240:360]  # rows count from below
        self.assertEqual(lamp.min(), 255, "the lamp is not bright, or hidden")
        inside = pixels[60:340, 110:490].reshape(-1, 3)
        self.assertGreater(len(set(map(tuple, inside.tolist()))), 500, "light on cells has many colours")


if __name__ == "__main__":
    unittest.main()
