// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LightArrays_h
#define irradiance_LightArrays_h

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>

class vtkDataSetAttributes;

namespace irradiance
{

/// The arrays of a light that has a value, and perhaps a standard error, in each band.
class LightArrays
{
public:
  /// Adds them to attributes.
  LightArrays(vtkDataSetAttributes* attributes, const std::string& name, int bands,
    vtkIdType tuples, bool haveErrors);

  bool haveErrors() const { return errors_ != nullptr; }
  /// `light`: see SensorFinalGather::Light.
  template <class Light>
  void set(vtkIdType tuple, const Light& light) const
  {
    for (int band = 0; band < values_->GetNumberOfComponents(); ++band)
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

#endif
