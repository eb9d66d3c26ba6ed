#include "Kernels/CastCounts.h"

namespace irradiance
{

CastCounts*& castCounts()
{
  static thread_local CastCounts* counts = nullptr;
  return counts;
}

}
