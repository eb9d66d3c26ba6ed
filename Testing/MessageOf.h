// SPDX-License-Identifier: BSD-3-Clause
#ifndef MessageOf_h
#define MessageOf_h

#include <exception>
#include <functional>
#include <string>

/// What the exception says that an action throws.
inline std::string MessageOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "nothing thrown";
}

#endif
