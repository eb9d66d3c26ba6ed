#ifndef CpuTime_h
#define CpuTime_h

#include "Execution/Execution.h"
#include "Timing.h"

/// One thread by its CPU time: other programs do not disturb it.
class CpuTime : public irradiance::Execution
{
public:
  double seconds() const override { return threadCpuSeconds(); }
};

#endif
