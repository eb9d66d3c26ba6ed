// SPDX-License-Identifier: BSD-3-Clause
#ifndef SameBits_h
#define SameBits_h

class vtkMultiBlockDataSet;

namespace movingteapot
{

/** Whether the irradiance of two lit scenes is the same on every cell, bit for bit. */
bool HaveSameBits(vtkMultiBlockDataSet* a, vtkMultiBlockDataSet* b);

}

#endif
