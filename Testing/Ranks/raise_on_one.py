# SPDX-License-Identifier: BSD-3-Clause
"""Under mpirun: an exception on one process while the others wait for it in an update."""
import os

import vtkIrradiance

controller = vtkIrradiance.use_mpi()
print("pid", os.getpid(), flush=True)
if controller.GetLocalProcessId() == 1:
    raise ZeroDivisionError("on one process")
controller.Barrier()
