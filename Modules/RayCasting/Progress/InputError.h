// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_InputError_h
#define irradiance_InputError_h

#include <sstream>
#include <stdexcept>
#include <string>

namespace irradiance
{

/// Input that cannot be computed; the text names the input, the cell and the value.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// For checks that are rare: the message is made in any case.
inline void throwIf(bool isWrong, const std::string& message)
{
  if (isWrong)
  {
    throw InputError(message);
  }
}

/// A value as a message shows it, with enough digits that 1.000000001 does not look like 1.
inline std::string text(double value)
{
  std::ostringstream stream;
  stream.precision(10);
  stream << value;
  return stream.str();
}

}

#endif
