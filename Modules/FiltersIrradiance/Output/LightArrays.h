// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"

#include "vtkDoubleArray.h"

namespace irradiance
{

/// The arrays of a light that has a value, and perhaps a standard error, in each band.
class LightArrays
{
public:
  /// Adds them to attributes.
  LightArrays(
    vtkFieldData* attributes, const std::string& name, int bands, vtkIdType tuples, bool haveErrors)
    : values_(addArray<vtkDoubleArray>(attributes, name, bands, tuples))
    , errors_(haveErrors
          ? addArray<vtkDoubleArray>(attributes, standardErrorName(name), bands, tuples)
          : nullptr)
  {
  }

  const char* name() const { return values_->GetName(); }
  int bands() const { return values_->GetNumberOfComponents(); }
  bool haveErrors() const { return errors_ != nullptr; }
  /// `light`: see SensorFinalGather::Light.
  template <class Light>
  void set(vtkIdType tuple, const Light& light) const
  {
    for (int band = 0; band < bands(); ++band)
    {
      const auto i = static_cast<std::size_t>(band);
      values_->SetTypedComponent(tuple, band, light.value[i]);
      if (errors_)
      {
        errors_->SetTypedComponent(tuple, band, light.standardError[i]);
      }
    }
  }

private:
  vtkSmartPointer<vtkDoubleArray> values_, errors_; ///< these may be null
};

}
