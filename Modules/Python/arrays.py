# SPDX-License-Identifier: BSD-3-Clause
"""Cell arrays from Python's numbers."""
from vtkmodules.vtkCommonCore import vtkDoubleArray


def add_cell_array(polydata, name, values):
    """Gives polydata a cell array such as "RadiantExitance", in place of one that is called so.

    `values` is one number, which all cells get; a list or a NumPy array of one number for each cell; or of a row of
    three for each cell, which makes three bands. Anything else is a ValueError. A NumPy array is shared with VTK,
    not copied: it must not be resized, and after writing into it call the VTK array's Modified().

    VTK's own way, append() of numpy_interface.dataset_adapter, repeats an array of another length in each cell: three
    numbers for nine cells become three bands, without a word.
    """
    cells = polydata.GetNumberOfCells()
    if _shape(values) == ():
        values = [values] * cells
    shape = _shape(values)
    if shape not in ((cells,), (cells, 3)):
        raise ValueError(f"{name}: values of shape {shape} for {cells} cells; the shape has to be ({cells},), "
                         f"or ({cells}, 3) for three bands")
    array = _shared(values) if hasattr(values, "__array_interface__") else _copied(values, len(shape) == 2)
    array.SetName(name)
    polydata.GetCellData().AddArray(array)
    polydata.Modified()


def _shape(values):
    """As NumPy has it; of a list, by its first row."""
    if hasattr(values, "shape"):
        return tuple(values.shape)
    if not hasattr(values, "__len__"):
        return ()
    return (len(values),) + (_shape(values[0]) if len(values) > 0 else ())


def _shared(values):
    from vtkmodules.util.numpy_support import numpy_to_vtk  # here, so that the package needs no NumPy
    return numpy_to_vtk(values)


def _copied(values, has_bands):
    array = vtkDoubleArray()
    array.SetNumberOfComponents(3 if has_bands else 1)
    for value in values:
        if has_bands and len(value) != 3:
            raise ValueError(f"a row of {len(value)} values among rows of 3")
        array.InsertNextTuple(value if has_bands else (value,))
    return array
