# SPDX-License-Identifier: BSD-3-Clause
"""One, two and three processes of pvbatch have the same cells, sums and pictures, and all of them compute."""
import os
import subprocess
import unittest

import pictures

HERE = os.path.dirname(os.path.abspath(__file__))


class Run:
    """What so many processes print and leave."""

    def __init__(self, ranks, script="ranks.py"):
        self.ranks = ranks
        self.folder = os.path.join(os.environ["OUTPUT"], f"Ranks{ranks}")
        os.makedirs(self.folder, exist_ok=True)
        # This process is one of MPI itself, and would be taken for the parent.
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("OMPI_", "ORTE_", "PMIX_"))}
        environment["OMPI_MCA_mpi_yield_when_idle"] = "1"
        log = subprocess.run(
            ["mpirun", "--allow-run-as-root", "--oversubscribe", "--timeout", "240", "-n", str(ranks),
             f"{os.environ['PARAVIEW_PREFIX']}/bin/pvbatch", f"{HERE}/{script}", self.folder],
            env=environment, capture_output=True, text=True, check=False)
        self.log = f"{ranks} processes: {log.stdout}{log.stderr}"
        lines = [line.split(maxsplit=1) for line in log.stdout.splitlines() if " " in line]
        self.results = [rest for kind, rest in lines if kind == "RESULT"]
        self.errors = sum("FilterRun" in line for line in self.log.splitlines())  # of our filters
        self.shares = sorted(rest.split() for kind, rest in lines if kind == "SHARE")

    def of_each_process(self, scene):
        """Bytes of stored walks, and numbers of cells."""
        shares = [[int(number) for number in numbers] for name, *numbers in self.shares if name == scene]
        assert [rank for rank, *_ in shares] == list(range(self.ranks)), self.log
        return [history for _, history, _ in shares], [cells for *_, cells in shares]


class Ranks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.alone, *cls.several = [Run(ranks) for ranks in (1, 2, 3)]

    def test_the_results_are_those_of_one_process(self):
        self.assertEqual(len(self.alone.results), 11, self.alone.log)
        for run in (self.alone, *self.several):
            self.assertEqual(run.errors, 0, run.log)
            self.assertEqual(run.results, self.alone.results, run.log)
            for picture in ("whole.png", "pieces.png"):
                pictures.check(self, f"{run.folder}/{picture}", f"{self.alone.folder}/{picture}", 1)

    def test_all_processes_compute(self):
        for scene in ("whole", "pieces"):
            (all_bytes,), (all_cells,) = self.alone.of_each_process(scene)
            for run in self.several:
                histories, cells = run.of_each_process(scene)
                for history in histories:  # each has its part, give or take the blocks of which parts are made
                    self.assertAlmostEqual(history * run.ranks / all_bytes, 1, delta=0.2, msg=run.log)
                if scene == "whole":  # was asked of each process
                    self.assertEqual(cells, [all_cells] * run.ranks)
                else:
                    self.assertEqual(sum(cells), all_cells)
                    self.assertGreater(min(cells), 0)

    def test_errors_come_and_go(self):
        run = Run(2, "ranks_errors.py")
        self.assertEqual(run.results, ["DefaultDiffuseReflectance 1693 50", "MaximumRadius 1693 50"], run.log)
        self.assertGreater(run.errors, 1, run.log)


if __name__ == "__main__":
    unittest.main()
