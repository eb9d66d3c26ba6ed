#include "Kernels/MeetingLanes.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void meetAll(MeetingLanes& lanes)
{
#ifdef __x86_64__
  switch (simdLevel())
  {
    case SimdLevel::Avx512:
      return meetAllAvx512(lanes);
    case SimdLevel::Avx2:
      return meetAllAvx2(lanes);
    case SimdLevel::Plain:
      break;
  }
#endif
  lanes.meet();
}

}
