// SPDX-License-Identifier: BSD-3-Clause
#include "Data/CellValues.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

namespace irradiance
{

SharedValues valuesOf(vtkDataArray* array)
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

}
