// SPDX-License-Identifier: BSD-3-Clause
#include "TimingTable.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <cstdio>
#include <ostream>
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

// All frames but the first.
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

Values Shootings(const Measurements& m)
{
  Values seconds(3);
  std::size_t count = 0;
  for (vtkFieldData* run : { m.Cached, m.Uncached, m.Afresh })
  {
    if (run)
    {
      seconds[count++] = ValuesOf(run, "ShootSeconds")[0];
    }
  }
  return seconds[std::slice(0, count, 1)];
}

class Table
{
public:
  Table(std::ostream& stream, double shootSeconds)
    : Stream(stream)
    , ShootSeconds(shootSeconds)
  {
  }

  template <typename... Arguments>
  void Write(const char* format, Arguments... arguments) const
  {
    char line[200];
    std::snprintf(line, sizeof line, format, arguments...);
    this->Stream << line;
  }

  void WriteSeconds(const char* name, const Values& ours, double paper) const
  {
    this->Write("%-34s %8.3f %8.3f %8.3f %8.3f %7.3f  |%6.2f %6.3f\n", name,
      ours.sum() / ours.size(), Median(ours), ours.min(), ours.max(),
      Median(ours) / this->ShootSeconds, paper, paper / PaperShoot);
  }

  void WritePercent(const char* name, const Values& part, const Values& whole) const
  {
    const Values ours = 100.0 * part / whole;
    this->Write("%-34s %7.1f%% %7.1f%% %7.1f%% %7.1f%%\n", name, ours.sum() / ours.size(),
      Median(ours), ours.min(), ours.max());
  }

private:
  std::ostream& Stream;
  double ShootSeconds; // the unit of the ratios
};

}

void WriteTimingTable(std::ostream& stream, const Measurements& m)
{
  const Values shoot = Shootings(m);
  const Values verify = UpdatesOf(m.Cached, "VerifySeconds");
  const Values repair = UpdatesOf(m.Cached, "RepairSeconds");
  const Values bytes = ValuesOf(m.Cached, "HistoryBytes");
  const Table table(stream, Median(shoot));
  table.Write("%-34s %8s %8s %8s %8s %7s  |%6s %6s\n", "Seconds", "mean", "median", "least", "most",
    "ratio", "paper", "ratio");
  table.WriteSeconds("First shooting", shoot, PaperShoot);
  table.WriteSeconds("Verification", verify, PaperVerify);
  if (m.Uncached)
  {
    table.WriteSeconds("Update, without static-hit cache", UpdatesOf(m.Uncached, "RepairSeconds"),
      PaperUpdateUncached);
  }
  table.WriteSeconds("Update, with static-hit cache", repair, PaperUpdateCached);
  table.WriteSeconds(
    "Verification + update with cache", verify + repair, PaperVerify + PaperUpdateCached);
  table.WritePercent("Walks found invalid", UpdatesOf(m.Cached, "NumberOfInvalidWalks"),
    UpdatesOf(m.Cached, "NumberOfWalks"));
  table.WritePercent("Path segments shot again", UpdatesOf(m.Cached, "NumberOfRepairedSegments"),
    UpdatesOf(m.Cached, "NumberOfSegments"));
  table.Write("%-34s %.2f GB at first, %.2f GB at most\n", "Memory of the stored walks",
    bytes[0] / 1e9, bytes.max() / 1e9);
}

}
