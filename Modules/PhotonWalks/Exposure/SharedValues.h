// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SharedValues_h
#define irradiance_SharedValues_h

#include <memory>

namespace irradiance
{

/// Values that live as long as this does.
using SharedValues = std::shared_ptr<const double[]>;

}

#endif
