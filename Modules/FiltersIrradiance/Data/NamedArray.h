// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Exposure/ReplicateSums.h"
#include "Progress/InputError.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <string>
#include <vector>

namespace irradiance
{

/// Adds an array, whose values are to be set.
template <class Array>
vtkSmartPointer<Array> addArray(
  vtkFieldData* attributes, const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  attributes->AddArray(array);
  return array;
}

/// Adds an array of one tuple.
template <class Array>
void addTuple(vtkFieldData* fields, const std::string& name,
  const std::vector<typename Array::ValueType>& tuple)
{
  const auto array = addArray<Array>(fields, name, static_cast<int>(tuple.size()), 1);
  std::copy(tuple.begin(), tuple.end(), array->GetPointer(0));
}

/// Adds an array of one component.
inline void addColumn(
  vtkFieldData* fields, const std::string& name, const std::vector<double>& values)
{
  const auto array =
    addArray<vtkDoubleArray>(fields, name, 1, static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
}

/// Adds an array of one text, unless that is empty.
inline void addText(vtkFieldData* fields, const std::string& name, const std::string& text)
{
  if (!text.empty())
  {
    addArray<vtkStringArray>(fields, name, 1, 1)->SetValue(0, text);
  }
}

/// The values of an array as doubles; they share it if it has doubles. Null for null.
inline SharedValues valuesOf(vtkDataArray* array)
{
  if (!array)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDoubleArray> doubles = vtkDoubleArray::SafeDownCast(array);
  if (!doubles)
  {
    doubles = vtkSmartPointer<vtkDoubleArray>::New();
    doubles->DeepCopy(array);
  }
  return { doubles->GetPointer(0), [doubles](const double*) {} };
}

/// All values of a field-data array of one component. Throws InputError; `missing`: if there is none.
inline std::vector<double> columnOf(
  const std::string& where, vtkFieldData* fields, const char* name, const std::string& missing)
{
  vtkDataArray* const array = fields->GetArray(name);
  throwIf(!array, where, missing);
  throwIf(array->GetNumberOfComponents() != 1, where, ": the field-data array ", name, " has ",
    array->GetNumberOfComponents(), " components; 1 is possible");
  const SharedValues values = valuesOf(array);
  return { values.get(), values.get() + array->GetNumberOfTuples() };
}

}
