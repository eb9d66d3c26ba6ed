# SPDX-License-Identifier: BSD-3-Clause
"""Fails unless two .vtm files hold the same blocks, points, cells and arrays, bit for bit; times are left out.

    same_bits.py FILE FILE
"""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader


def read(name):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def arrays_of(attributes, where):
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        if not array.GetName().endswith("Seconds"):
            yield f"{where} {array.GetName()}", array


def cells_of(polydata):
    for name in ("Verts", "Lines", "Polys", "Strips"):
        cells = getattr(polydata, f"Get{name}")()
        yield f"{name} offsets", cells.GetOffsetsArray()
        yield f"{name} points", cells.GetConnectivityArray()


def contents(output):
    """The bytes of each array of a composite data set, by a name that says where it is."""
    found = dict(arrays_of(output.GetFieldData(), "field data"))
    iterator = output.NewIterator()
    while not iterator.IsDoneWithTraversal():
        block = f"block {iterator.GetCurrentFlatIndex()}"
        leaf = iterator.GetCurrentDataObject()
        if leaf.GetPoints():
            found[f"{block} points"] = leaf.GetPoints().GetData()
        found.update((f"{block} {name}", array) for name, array in cells_of(leaf))
        found.update(arrays_of(leaf.GetCellData(), f"{block} cells'"))
        found.update(arrays_of(leaf.GetPointData(), f"{block} points'"))
        iterator.GoToNextItem()
    return {name: (array.GetNumberOfComponents(), array.GetDataTypeAsString(), vtk_to_numpy(array).tobytes())
            for name, array in found.items()}


def main(first, second):
    ours, theirs = contents(read(first)), contents(read(second))
    differing = [name for name in sorted({*ours, *theirs}) if ours.get(name) != theirs.get(name)]
    irradiances = [name for name in ours if name.endswith(" Irradiance") and ours[name][2].strip(b"\0")]
    print(f"{len(ours)} arrays, {len(irradiances)} of them irradiance")
    if differing:
        sys.exit("not the same: " + ", ".join(differing))
    if not irradiances:
        sys.exit(f"{first} holds no light")


if __name__ == "__main__":
    main(*sys.argv[1:])
