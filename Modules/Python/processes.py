# SPDX-License-Identifier: BSD-3-Clause
"""Working with other processes."""
import atexit
import ctypes
import re


def use_mpi():
    """Starts MPI, unless somebody has, and makes the processes that mpirun has started VTK's global controller.

    Returns that controller, a vtkMPIController. Filters that are made afterwards share their work over these
    processes. What was started here ends with Python. Needs VTK's module vtkParallelMPI, and no other package.
    """
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    if _start():
        atexit.register(controller.Finalize)
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    return controller


def _start():
    """Whether MPI was started just now. VTK starts it only with the arguments of a C++ program."""
    mpi = ctypes.CDLL(_library())
    started = ctypes.c_int()
    mpi.MPI_Initialized(ctypes.byref(started))
    if started:
        return False
    mpi.MPI_Init(None, None)
    return True


def _library():
    """The file of the MPI that VTK has loaded."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        for line in maps:
            if re.search(r"/libmpi(ch)?\.so[.0-9]*$", line.rstrip()):
                return line.split()[-1]
    raise RuntimeError("VTK's vtkParallelMPI has loaded no MPI that is known here")
