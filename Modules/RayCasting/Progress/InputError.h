// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <locale>
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

/// Parts of a message, one after the other; numbers with enough digits that 1.000000001 does not look
/// like 1.
template <class... Parts>
std::string joined(const Parts&... parts)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(10);
  (stream << ... << parts);
  return stream.str();
}

/// The message is made of the parts only if something is wrong.
template <class... Parts>
void throwIf(bool isWrong, const Parts&... parts)
{
  if (isWrong)
  {
    throw InputError(joined(parts...));
  }
}

/// A value as a message shows it.
inline std::string text(double value)
{
  return joined(value);
}

}
