# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/ParaView.md: its steps are taken in ParaView's window, whose own trace, run by pvpython, makes the
picture of the page. Leaves step1.png to step5.png, the window after each step, as on the page.

    pvpython TestFiveSteps.py
"""
import glob
import os
import subprocess
import sys
import time
import unittest

import pictures

HERE = os.path.dirname(os.path.abspath(__file__))
OUTPUT = os.environ["OUTPUT"]
PAGES = os.path.join(HERE, "../../Documentation/pictures")
SDK = os.environ["PARAVIEW_PREFIX"]


def wait_for(file_name, process, seconds=100):
    end = time.monotonic() + seconds
    while not os.path.exists(file_name) and process.poll() is None and time.monotonic() < end:
        time.sleep(0.1)
    return os.path.exists(file_name)


def libraries():
    """The folder of Qt's libraries that were unpacked beside ParaView."""
    return glob.glob(f"{SDK}/lib/*/qt5/plugins")[0][:-len("/qt5/plugins")]


class FiveSteps(unittest.TestCase):
    def test_the_windows_trace_makes_the_pages_picture(self):
        done, trace = os.path.join(OUTPUT, "done"), os.path.join(OUTPUT, "trace.py")
        picture = os.path.join(OUTPUT, "five-steps.png")
        windows = [os.path.join(OUTPUT, f"step{step}.png") for step in range(1, 6)]
        for old in (done, trace, picture, *windows):
            if os.path.exists(old):
                os.remove(old)
        # Settings of the user's home must not change the picture.
        environment = {**os.environ, "LD_LIBRARY_PATH": libraries(), "HOME": OUTPUT, "XDG_RUNTIME_DIR": OUTPUT,
                       "QT_PLUGIN_PATH": f"{libraries()}/qt5/plugins", "QT_X11_NO_MITSHM": "1",
                       "FIVE_STEPS": f"{HERE}/five_steps.py"}
        window = subprocess.Popen(
            [f"{SDK}/bin/paraview", "--dr", f"--script={HERE}/five_steps.py"], env=environment)
        try:
            self.assertTrue(wait_for(done, window), "the steps were not taken")
        finally:
            window.kill()
            window.wait()
        contents = [open(window, "rb").read() for window in windows]
        self.assertEqual(len(set(contents)), 5, "each step shows")
        with open(trace, "a", encoding="utf-8") as file:
            file.write(f"\nSaveScreenshot({picture!r}, renderView1, ImageResolution=[600, 400])\n")
        load = "from paraview.simple import *; LoadDistributedPlugin('IrradiancePlugin', remote=False, ns=globals()); "
        subprocess.run([f"{SDK}/bin/pvpython", "-c", load + f"exec(open({trace!r}).read())"], check=True)
        pictures.check(self, picture, os.path.join(PAGES, "ParaViewFiveSteps.png"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
