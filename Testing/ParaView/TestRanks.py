# SPDX-License-Identifier: BSD-3-Clause
"""One, two and three processes of pvbatch have the same cells, sums and picture."""
import os
import subprocess
import unittest

import pictures

OUTPUT = os.environ["OUTPUT"]
HERE = os.path.dirname(os.path.abspath(__file__))


def run(ranks):
    """The lines of the result and the picture."""
    picture = os.path.join(OUTPUT, f"Ranks{ranks}.png")
    # This process is one of MPI itself, and would be taken for the parent.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "ORTE_", "PMIX_"))}
    log = subprocess.run(
        ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks),
         f"{os.environ['PARAVIEW_PREFIX']}/bin/pvbatch", f"{HERE}/ranks.py", picture],
        env=environment, capture_output=True, text=True, check=False)
    lines = [line for line in log.stdout.splitlines() if line.startswith("RESULT")]
    return lines, picture, log.stdout + log.stderr


class Ranks(unittest.TestCase):
    def test_each_cell_once(self):
        expected, picture, log = run(1)
        self.assertEqual(len(expected), 5, log)
        self.assertNotIn("FilterRun", log)  # which reports our filters' errors
        for ranks in (2, 3):
            lines, other, log = run(ranks)
            self.assertEqual(lines, expected, f"{ranks} processes: {log}")
            self.assertNotIn("FilterRun", log)
            pictures.check(self, other, picture, 1)


if __name__ == "__main__":
    unittest.main()
