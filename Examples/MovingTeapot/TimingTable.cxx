// SPDX-License-Identifier: BSD-3-Clause
#include "TimingTable.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <cstdio>
#include <valarray>

namespace movingteapot
{
namespace
{

// Szecsi, Benedek and Szirmay-Kalos, section 5: seconds on a Pentium 4 with 1.4 GHz.
constexpr double PaperShoot = 5.54;
constexpr double PaperVerify = 0.78;
constexpr double PaperUpdateUncached = 0.16;
constexpr double PaperUpdateCached = 0.11;

using Values = std::valarray<double>;

Values ValuesOf(vtkFieldData* run, const char* name)
{
  vtkDataArray* array = run->GetArray(name);
  Values values(array->GetNumberOfTuples());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetTuple1(i);
  }
  return values;
}

Values UpdatesOf(vtkFieldData* run, const char* name)
{
  const Values values = ValuesOf(run, name);
  return values[std::slice(1, values.size() - 1, 1)];
}

double Median(Values values)
{
  std::sort(std::begin(values), std::end(values));
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

void PrintSeconds(const char* name, const Values& ours, double shoot, double paper)
{
  std::printf("%-34s %8.3f %8.3f %8.3f %8.3f %7.3f  |%6.2f %6.3f\n", name, ours.sum() / ours.size(),
    Median(ours), ours.min(), ours.max(), Median(ours) / shoot, paper, paper / PaperShoot);
}

void PrintPercent(const char* name, vtkFieldData* run, const char* part, const char* whole)
{
  const Values ours = 100.0 * UpdatesOf(run, part) / UpdatesOf(run, whole);
  std::printf("%-34s %7.1f%% %7.1f%% %7.1f%% %7.1f%%\n", name, ours.sum() / ours.size(),
    Median(ours), ours.min(), ours.max());
}

}

void PrintTimingTable(vtkFieldData* cached, vtkFieldData* uncached, vtkFieldData* afresh)
{
  const bool isCompared = uncached->GetNumberOfTuples() > 0;
  Values shootings = ValuesOf(cached, "ShootSeconds")[std::slice(0, 1, 1)];
  if (isCompared)
  {
    shootings = { shootings[0], ValuesOf(uncached, "ShootSeconds")[0],
      ValuesOf(afresh, "ShootSeconds")[0] };
  }
  const double shoot = Median(shootings);
  const Values verify = UpdatesOf(cached, "VerifySeconds");
  const Values repair = UpdatesOf(cached, "RepairSeconds");
  const Values bytes = ValuesOf(cached, "HistoryBytes");

  std::printf("\n%-34s %8s %8s %8s %8s %7s  |%6s %6s\n", "Seconds", "mean", "median", "least",
    "most", "ratio", "paper", "ratio");
  PrintSeconds("First shooting", shootings, shoot, PaperShoot);
  PrintSeconds("Verification", verify, shoot, PaperVerify);
  if (isCompared)
  {
    PrintSeconds("Update, without static-hit cache", UpdatesOf(uncached, "RepairSeconds"), shoot,
      PaperUpdateUncached);
  }
  PrintSeconds("Update, with static-hit cache", repair, shoot, PaperUpdateCached);
  PrintSeconds(
    "Verification + update with cache", verify + repair, shoot, PaperVerify + PaperUpdateCached);
  PrintPercent("Walks found invalid", cached, "NumberOfInvalidWalks", "NumberOfWalks");
  PrintPercent("Path segments shot again", cached, "NumberOfRepairedSegments", "NumberOfSegments");
  std::printf("%-34s %.2f GB at first, %.2f GB at most\n", "Memory of the stored walks",
    bytes[0] / 1e9, bytes.max() / 1e9);
}

}
