// SPDX-License-Identifier: BSD-3-Clause
#include "Output/LightArrays.h"

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"

#include "vtkDataSetAttributes.h"

namespace irradiance
{

LightArrays::LightArrays(vtkDataSetAttributes* attributes, const std::string& name, int bands,
  vtkIdType tuples, bool haveErrors)
  : values_(addArray<vtkDoubleArray>(attributes, name, bands, tuples))
  , errors_(haveErrors
        ? addArray<vtkDoubleArray>(attributes, standardErrorName(name), bands, tuples)
        : nullptr)
{
}

}
