// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DataMessage_h
#define irradiance_DataMessage_h

#include "vtkSmartPointer.h"

class vtkCharArray;
class vtkDataObject;

namespace irradiance
{

/// A data set, or a tree of them, as bytes for another process: structure, names, geometry and
/// arrays, bit for bit, but no information keys. In VTK's own format. Throws InputError if VTK
/// cannot write it.
vtkSmartPointer<vtkCharArray> messageOf(vtkDataObject* data);

/// The data of a message. Throws InputError if VTK cannot read it.
vtkSmartPointer<vtkDataObject> dataOf(vtkCharArray* message);

}

#endif
