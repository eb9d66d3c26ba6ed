# SPDX-License-Identifier: BSD-3-Clause
"""Under mpirun: an exception on one process while the others wait for it in an update."""
import os
import time

import vtkIrradiance

controller = vtkIrradiance.use_mpi()
os.write(1, f"pid {os.getpid()}\n".encode())  # at once
controller.Barrier()
time.sleep(0.5)  # so that what they say does not mix
if controller.GetLocalProcessId() == 1:
    raise ZeroDivisionError("on one process")
controller.Barrier()
