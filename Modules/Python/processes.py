# SPDX-License-Identifier: BSD-3-Clause
"""Working with other processes."""
import atexit
import ctypes
import re
import sys


def use_mpi():
    """Starts MPI, unless somebody has, and makes the processes that mpirun has started VTK's global controller.

    Returns that controller, a vtkMPIController. Filters that are made afterwards share their work over these
    processes. What was started here ends with Python. Needs VTK's module vtkParallelMPI, and no other package.
    An exception that nobody catches on one process ends all, after its traceback: the others would wait for it.
    """
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    if _start():
        atexit.register(controller.Finalize)
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    if controller.GetNumberOfProcesses() > 1:
        _end_all_with_one()
    return controller


def _end_all_with_one():
    """Lets an exception that ends this process end all, as mpi4py's runner does."""
    mpi, show = ctypes.CDLL(_library()), sys.excepthook
    try:
        world = ctypes.byref(ctypes.c_byte.in_dll(mpi, "ompi_mpi_comm_world"))  # of Open MPI
    except ValueError:
        world = ctypes.c_int(0x44000000)  # of MPICH and its kin

    def end(*exception):
        show(*exception)
        sys.stdout.flush()
        sys.stderr.flush()
        mpi.MPI_Abort(world, 1)

    sys.excepthook = end


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
