# SPDX-License-Identifier: BSD-3-Clause
"""A script in ParaView's window."""
import glob
import os
import subprocess
import tempfile
import time

SDK = os.environ["PARAVIEW_PREFIX"]


def wait_for(file_name, process, seconds=200):
    end = time.monotonic() + seconds
    while not os.path.exists(file_name) and process.poll() is None and time.monotonic() < end:
        time.sleep(0.1)
    return os.path.exists(file_name)


def run(script, done):
    """Whether the script, which finds its folder as SCRIPTS, left the file `done`. Then the window is closed."""
    if os.path.exists(done):
        os.remove(done)
    with tempfile.TemporaryDirectory() as home:  # settings of the user's own must not change the picture
        environment = {**os.environ, "HOME": home, "XDG_RUNTIME_DIR": home,
                       "QT_PLUGIN_PATH": ":".join(glob.glob(f"{SDK}/lib/*/qt[0-9]/plugins")), "QT_X11_NO_MITSHM": "1",
                       "SCRIPTS": os.path.dirname(script)}
        window = subprocess.Popen([f"{SDK}/bin/paraview", "--dr", f"--script={script}"], env=environment)
        try:
            return wait_for(done, window)
        finally:
            window.kill()
            window.wait()
