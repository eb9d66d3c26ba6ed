// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>

#include <iostream>
#include <stdexcept>
#include <string>

namespace movingteapot
{

/** While it lives, VTK's errors are kept to become one exception, and not printed. */
class VtkErrors
{
public:
  VtkErrors()
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(this->Texts);
  }
  ~VtkErrors()
  {
    vtkOutputWindow::SetInstance(this->Window);
    vtkLogger::SetStderrVerbosity(this->Verbosity);
  }

  /** Throws std::runtime_error, "what: first error", if there was one; prints mere warnings. */
  void ThrowIfAny(const std::string& what) const
  {
    const std::string text = this->Texts->GetOutput();
    const std::size_t error = text.find("ERROR: ");
    if (error == std::string::npos)
    {
      std::cerr << text;
      return;
    }
    // "ERROR: In file, line 7\nvtkThing (0x1234): what is wrong\n\n" says much to few.
    const std::size_t begin = text.find("): ", error) + 3;
    throw std::runtime_error(what + ": " + text.substr(begin, text.find("\n\n", begin) - begin));
  }

private:
  vtkSmartPointer<vtkOutputWindow> Window = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity Verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<vtkStringOutputWindow> Texts;
};

}
