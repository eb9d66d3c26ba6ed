# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/ParaView.md: its steps are taken in ParaView's window, whose own trace, run by pvpython, makes the
picture of the page. Leaves step1.png to step5.png, the window after each step, as on the page.

    pvpython TestFiveSteps.py
"""
import os
import subprocess
import sys
import unittest

import pictures
import window

HERE = os.path.dirname(os.path.abspath(__file__))
OUTPUT = os.environ["OUTPUT"]
PAGES = os.path.join(HERE, "../../Documentation/pictures")


class FiveSteps(unittest.TestCase):
    def test_the_windows_trace_makes_the_pages_picture(self):
        done, trace = os.path.join(OUTPUT, "done"), os.path.join(OUTPUT, "trace.py")
        picture = os.path.join(OUTPUT, "five-steps.png")
        screens = [os.path.join(OUTPUT, f"step{step}.png") for step in range(1, 6)]
        for old in (done, trace, picture, *screens):
            if os.path.exists(old):
                os.remove(old)
        self.assertTrue(window.run(f"{HERE}/five_steps.py", done), "the steps were not taken")
        contents = [open(screen, "rb").read() for screen in screens]
        self.assertEqual(len(set(contents)), 5, "each step shows")
        with open(trace, "a", encoding="utf-8") as file:
            file.write(f"\nSaveScreenshot({picture!r}, renderView1, ImageResolution=[600, 400])\n")
        load = "from paraview.simple import *; LoadDistributedPlugin('IrradiancePlugin', remote=False, ns=globals()); "
        subprocess.run([f"{window.SDK}/bin/pvpython", "-c", load + f"exec(open({trace!r}).read())"], check=True)
        pictures.check(self, picture, os.path.join(PAGES, "ParaViewFiveSteps.png"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
