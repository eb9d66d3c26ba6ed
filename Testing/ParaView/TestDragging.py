# SPDX-License-Identifier: BSD-3-Clause
"""The light follows a part while its box is dragged in ParaView's window, as Documentation/Guide.md says. Leaves
dragging.png, the window meanwhile.

    pvpython TestDragging.py
"""
import json
import os
import sys
import unittest

import window

HERE = os.path.dirname(os.path.abspath(__file__))
DONE = os.path.join(os.environ["OUTPUT"], "dragging.json")


class Dragging(unittest.TestCase):
    def test_the_light_follows_the_handle(self):
        self.assertTrue(window.run(f"{HERE}/dragging.py", DONE), "the part was not dragged")
        with open(DONE, encoding="utf-8") as file:
            found = json.load(file)
        first, *states = found["states"]
        self.assertEqual(first["handle"], [0, 0, 0])
        self.assertEqual(first["stale"], 0)
        for before, state in zip([first, *states], states):
            self.assertGreater(state["executions"], before["executions"], "before the button is released")
            self.assertGreater(state["handle"][0], before["handle"][0])
            for place, moved, start in zip(state["part"], state["handle"], first["part"]):
                self.assertAlmostEqual(place, start + moved, delta=1e-4)
        self.assertGreater(states[-1]["stale"], 0, "the budget ends each repair")
        self.assertEqual(found["released"], states[-1], "nothing settles by itself")
        self.assertEqual(found["settled"]["stale"], 0)
        self.assertTrue(found["settled"]["is exact"])
        self.assertEqual(found["settled"]["part"], states[-1]["part"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
