#ifndef irradiance_InputError_h
#define irradiance_InputError_h

#include <stdexcept>

namespace irradiance
{

/// Input that cannot be computed; the text names the input, the cell and the value.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

}

#endif
