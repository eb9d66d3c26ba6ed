#include "Machine.h"

#include <vtkVersion.h>
#include <vtksys/SystemInformation.hxx>

#include <ctime>
#include <sstream>

namespace
{

const char* widestInstructions()
{
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("avx512f") ? "AVX-512"
    : __builtin_cpu_supports("avx2")       ? "AVX2"
                                           : "SSE2";
#else
  return "not looked for";
#endif
}

std::string today()
{
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

}

std::string describeMachine()
{
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  system.RunOSCheck();
  system.RunMemoryCheck();
  std::ostringstream list;
  list << "* Processor: " << system.GetModelName() << ", " << system.GetNumberOfLogicalCPU()
       << " logical processors; SIMD: " << widestInstructions()
       << "; memory: " << system.GetTotalPhysicalMemory() / 1024 << " GiB\n"
       << "* System: " << system.GetOSName() << ' ' << system.GetOSRelease() << '\n'
       << "* Compiler: " VTKIRRADIANCE_COMPILER "\n"
       << "* VTK " << vtkVersion::GetVTKVersion()
       << ", Embree " VTKIRRADIANCE_EMBREE ", CGAL " VTKIRRADIANCE_CGAL "\n"
       << "* Date: " << today() << '\n';
  return list.str();
}
