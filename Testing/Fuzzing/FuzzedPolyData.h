// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ByteReader.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

/// Polydata as nobody should make it: cells of all kinds, indices past the points, arrays of wrong
/// sizes and types, values that are no numbers. Most of it is valid, so the filter gets far.
namespace FuzzedPolyData
{

using irradiance::fuzzing::ByteReader;

inline vtkSmartPointer<vtkPoints> ReadPoints(ByteReader& bytes)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(bytes.oneIn(2) ? VTK_FLOAT : VTK_DOUBLE);
  const bool isTame = !bytes.oneIn(4); // one in four may be out of all ranges
  for (int i = bytes.below(17); i > 0; --i)
  {
    const auto coordinate = [&] { return isTame ? bytes.numberWithin(1e6) : bytes.number(); };
    const double x = coordinate(), y = coordinate();
    points->InsertNextPoint(x, y, coordinate());
  }
  return points;
}

inline vtkIdType ReadId(ByteReader& bytes, vtkIdType points)
{
  const int id = bytes.byte();
  if (points == 0 || id == 255)
  {
    return bytes.byte() - 128; // rarely in range
  }
  return id % points;
}

inline vtkSmartPointer<vtkCellArray> ReadCells(ByteReader& bytes, vtkIdType points)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (bytes.oneIn(64))
  {
    // Anything as offsets and connectivity.
    vtkNew<vtkIdTypeArray> offsets, connectivity;
    for (vtkIdTypeArray* array : { offsets.Get(), connectivity.Get() })
    {
      for (int i = bytes.below(8); i > 0; --i)
      {
        array->InsertNextValue(bytes.byte() - 16);
      }
    }
    cells->SetData(offsets, connectivity);
    return cells;
  }
  for (int i = bytes.below(9); i > 0; --i)
  {
    const int size = bytes.oneIn(4) ? bytes.below(9) : 3 + bytes.below(2);
    cells->InsertNextCell(size);
    for (int k = 0; k < size; ++k)
    {
      cells->InsertCellPoint(ReadId(bytes, points));
    }
  }
  return cells;
}

/// `tame(i)`: values as they should be, for i from 0 to 8.
template <class Tame>
vtkSmartPointer<vtkAbstractArray> ReadArray(
  ByteReader& bytes, const char* name, vtkIdType cells, const Tame& tame)
{
  const auto make = [](int kind) -> vtkSmartPointer<vtkAbstractArray> {
    switch (kind)
    {
      case 0:
        return vtkSmartPointer<vtkFloatArray>::New();
      case 1:
        return vtkSmartPointer<vtkIntArray>::New();
      case 31:
        return vtkSmartPointer<vtkStringArray>::New();
      default:
        return vtkSmartPointer<vtkDoubleArray>::New();
    }
  };
  const auto array = make(bytes.below(32));
  array->SetName(name);
  constexpr int components[] = { 1, 1, 1, 3 };
  array->SetNumberOfComponents(bytes.oneIn(32) ? bytes.below(5) : components[bytes.below(4)]);
  array->SetNumberOfTuples(bytes.oneIn(32) ? bytes.below(20) : cells);
  const bool isTame = !bytes.oneIn(8);
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < numbers->GetNumberOfComponents(); ++k)
      {
        double value = isTame ? tame(bytes.below(9)) : bytes.number();
        if (numbers->GetDataType() == VTK_INT && !(std::abs(value) < 1e9))
        {
          value = 0; // no int can hold it
        }
        numbers->SetComponent(i, k, value);
      }
    }
  }
  return array;
}

/// 16 values, a matrix most of the time.
inline vtkSmartPointer<vtkDoubleArray> ReadMatrix(ByteReader& bytes)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("ObjectToWorld");
  const int kind = bytes.below(8);
  for (int i = 0; i < 16; ++i)
  {
    const double identity = i % 5 == 0 ? 1 : 0;
    const bool isGiven = kind == 0 || (i < 12 && (kind < 4 || i % 4 == 3));
    array->InsertNextValue(!isGiven ? identity
        : kind == 1                 ? bytes.number()
                                    : bytes.numberWithin(1e6));
  }
  if (bytes.oneIn(32))
  {
    array->SetNumberOfTuples(bytes.below(20));
  }
  return array;
}

inline void ReadArrays(ByteReader& bytes, vtkPolyData* polyData)
{
  const int arrays = bytes.byte();
  const auto add = [&](const char* name, const auto& tame) {
    polyData->GetCellData()->AddArray(ReadArray(bytes, name, polyData->GetNumberOfCells(), tame));
  };
  const auto upTo = [](double high) { return [high](int i) { return i / 8.0 * high; }; };
  const bool isGlossy = (arrays & 32) != 0;
  if ((arrays & 1) == 0)
  {
    add("RadiantExitance", upTo(8));
  }
  if ((arrays & 2) != 0)
  {
    add("DiffuseReflectance", upTo(isGlossy ? 0.5 : 0.97));
  }
  if ((arrays & 4) != 0)
  {
    add("RadiantFlux", upTo(4));
  }
  if ((arrays & 24) == 24)
  {
    polyData->GetFieldData()->AddArray(ReadMatrix(bytes));
  }
  if (isGlossy)
  {
    add("SpecularReflectance", upTo(0.47));
  }
  if ((arrays & 64) != 0)
  {
    constexpr double exponents[] = { 0, 0.5, 1, 8, 100, 1e4, 1e30, 1e300, HUGE_VAL };
    add("PhongExponent", [&](int i) { return exponents[i]; });
  }
}

inline vtkSmartPointer<vtkPolyData> Read(ByteReader& bytes)
{
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  if (bytes.oneIn(32))
  {
    return polyData; // nothing in it, not even points
  }
  const auto points = ReadPoints(bytes);
  polyData->SetPoints(points);
  const int kinds = bytes.byte();
  if ((kinds & 1) == 0)
  {
    polyData->SetPolys(ReadCells(bytes, points->GetNumberOfPoints()));
  }
  if ((kinds & 2) != 0)
  {
    polyData->SetVerts(ReadCells(bytes, points->GetNumberOfPoints()));
  }
  if ((kinds & 12) == 12)
  {
    polyData->SetStrips(ReadCells(bytes, points->GetNumberOfPoints()));
  }
  if ((kinds & 48) == 48)
  {
    polyData->SetLines(ReadCells(bytes, points->GetNumberOfPoints()));
  }
  ReadArrays(bytes, polyData);
  return polyData;
}

}
