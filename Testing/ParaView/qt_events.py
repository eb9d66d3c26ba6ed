# SPDX-License-Identifier: BSD-3-Clause
"""The events of ParaView's window, for scripts in it: a script keeps the window from doing anything."""
import ctypes
import time

# PyDLL: the window calls Python while it draws itself. None: in ParaView itself, with whichever Qt it has.
_process_events = getattr(ctypes.PyDLL(None),
                          "_ZN16QCoreApplication13processEventsE6QFlagsIN10QEventLoop17ProcessEventsFlagEE")


def process_events(seconds, until=lambda: False):
    """For so many seconds, or until something is the case."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and not until():
        _process_events(0)
