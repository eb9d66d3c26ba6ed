// SPDX-License-Identifier: BSD-3-Clause
#include "TimingTable.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <ostream>
#include <string>

namespace movingteapot
{
namespace
{

// Szecsi, Benedek and Szirmay-Kalos, section 5: seconds on a Pentium 4 with 1.4 GHz.
constexpr double PaperShoot = 5.54;
constexpr double PaperVerify = 0.78;
constexpr double PaperUpdateUncached = 0.16;
constexpr double PaperUpdateCached = 0.11;

struct Summary
{
  double Mean, Median, Least, Most;
};

// Of one figure over the updates of a run, the first shooting left out.
template <typename Figure>
Summary Summarize(const RunTiming& run, Figure figure)
{
  std::vector<double> values;
  for (std::size_t i = 1; i < run.size(); ++i)
  {
    values.push_back(figure(run[i]));
  }
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return { std::accumulate(values.begin(), values.end(), 0.0) / double(n),
    (values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back() };
}

double Verify(const FrameTiming& frame)
{
  return frame.VerifySeconds;
}

double Repair(const FrameTiming& frame)
{
  return frame.RepairSeconds;
}

double VerifyAndRepair(const FrameTiming& frame)
{
  return frame.VerifySeconds + frame.RepairSeconds;
}

double RepairedShare(const FrameTiming& frame)
{
  return frame.Segments > 0.0 ? frame.RepairedSegments / frame.Segments : 0.0;
}

class Table
{
public:
  Table(std::ostream& stream, double shootSeconds)
    : Stream(stream)
    , Shoot(shootSeconds)
  {
  }

  void WriteHeader() const
  {
    this->Write("%-32s %8s %8s %8s %8s %8s   %7s %6s\n", "seconds", "mean", "median", "least",
      "most", "ratio", "paper s", "ratio");
  }

  // A figure that each run has once.
  void WriteSingle(const char* name, double seconds) const
  {
    this->Write("%-32s %8.3f %8s %8s %8s %8.3f", name, seconds, "", "", "", seconds / this->Shoot);
  }

  void WriteSummary(const char* name, const Summary& s) const
  {
    this->Write("%-32s %8.3f %8.3f %8.3f %8.3f %8.3f", name, s.Mean, s.Median, s.Least, s.Most,
      s.Mean / this->Shoot);
  }

  void WritePaper(double seconds) const
  {
    this->Write("   %7.2f %6.3f\n", seconds, seconds / PaperShoot);
  }

  template <typename... Values>
  void Write(const char* format, Values... values) const
  {
    char line[200];
    std::snprintf(line, sizeof line, format, values...);
    this->Stream << line;
  }

private:
  std::ostream& Stream;
  double Shoot; // s, the unit of the ratios
};

}

void WriteTimingTable(
  std::ostream& stream, const RunTiming& cached, const RunTiming& uncached, double afreshSeconds)
{
  const double shoot = cached.front().ShootSeconds;
  const Table table(stream, shoot);
  table.WriteHeader();
  table.WriteSingle("First shooting", shoot);
  table.WritePaper(PaperShoot);
  table.WriteSummary("Verification", Summarize(cached, Verify));
  table.WritePaper(PaperVerify);
  table.WriteSummary("Update, without static-hit cache", Summarize(uncached, Repair));
  table.WritePaper(PaperUpdateUncached);
  table.WriteSummary("Update, with static-hit cache", Summarize(cached, Repair));
  table.WritePaper(PaperUpdateCached);
  table.WriteSummary("Verification + update", Summarize(cached, VerifyAndRepair));
  table.WritePaper(PaperVerify + PaperUpdateCached);
  table.WriteSingle("Last frame shot afresh", afreshSeconds);
  stream << '\n';

  const Summary shotAgain = Summarize(cached, RepairedShare);
  table.Write("%-32s %7.1f%% %7.1f%% %7.1f%% %7.1f%%\n", "Path segments shot again",
    100 * shotAgain.Mean, 100 * shotAgain.Median, 100 * shotAgain.Least, 100 * shotAgain.Most);
}

}
