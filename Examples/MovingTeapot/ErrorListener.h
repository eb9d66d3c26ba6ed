// SPDX-License-Identifier: BSD-3-Clause
#ifndef ErrorListener_h
#define ErrorListener_h

#include <string>

class vtkObject;

namespace movingteapot
{

/** Keeps what a VTK object complains about, instead of VTK's printing it. */
class ErrorListener
{
public:
  explicit ErrorListener(vtkObject* speaker);
  ~ErrorListener();
  ErrorListener(const ErrorListener&) = delete;
  ErrorListener& operator=(const ErrorListener&) = delete;

  /** Throws std::runtime_error, "what: first complaint", if there was one. */
  void ThrowIfAny(const std::string& what) const;

private:
  vtkObject* Speaker;
  unsigned long Tag;
  std::string FirstComplaint;
};

}

#endif
