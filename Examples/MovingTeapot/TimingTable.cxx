// SPDX-License-Identifier: BSD-3-Clause
#include "TimingTable.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <ostream>

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

Summary Summarize(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return { std::accumulate(values.begin(), values.end(), 0.0) / double(n),
    (values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back() };
}

// Of one figure over the updates of a run.
template <typename Figure>
Summary SummarizeUpdates(const std::vector<FrameReport>& run, Figure figure)
{
  std::vector<double> values;
  std::transform(run.begin() + 1, run.end(), std::back_inserter(values), figure);
  return Summarize(values);
}

double VerifySeconds(const FrameReport& frame)
{
  return frame.VerifySeconds;
}

double RepairSeconds(const FrameReport& frame)
{
  return frame.RepairSeconds;
}

double UpdateSeconds(const FrameReport& frame)
{
  return frame.VerifySeconds + frame.RepairSeconds;
}

double InvalidPercent(const FrameReport& frame)
{
  return 100.0 * frame.InvalidWalks / frame.Walks;
}

double RepairedPercent(const FrameReport& frame)
{
  return 100.0 * frame.RepairedSegments / frame.Segments;
}

double MostGigabytes(const std::vector<FrameReport>& run)
{
  double most = 0.0;
  for (const FrameReport& frame : run)
  {
    most = std::max(most, frame.HistoryBytes / 1e9);
  }
  return most;
}

class Table
{
public:
  Table(std::ostream& stream, double shootSeconds)
    : Stream(stream)
    , ShootSeconds(shootSeconds)
  {
  }

  template <typename... Values>
  void Write(const char* format, Values... values) const
  {
    char line[200];
    std::snprintf(line, sizeof line, format, values...);
    this->Stream << line;
  }

  void WriteSeconds(const char* name, const Summary& ours, double paper) const
  {
    this->Write("%-34s %8.3f %8.3f %8.3f %8.3f %7.3f  |%6.2f %6.3f\n", name, ours.Mean, ours.Median,
      ours.Least, ours.Most, ours.Median / this->ShootSeconds, paper, paper / PaperShoot);
  }

  void WritePercent(const char* name, const Summary& ours) const
  {
    this->Write("%-34s %7.1f%% %7.1f%% %7.1f%% %7.1f%%\n", name, ours.Mean, ours.Median, ours.Least,
      ours.Most);
  }

private:
  std::ostream& Stream;
  double ShootSeconds; // the unit of the ratios
};

}

void WriteTimingTable(std::ostream& stream, const Measurements& m)
{
  std::vector<double> shootings;
  for (const auto* run : { &m.Cached, &m.Uncached, &m.Afresh })
  {
    if (!run->empty())
    {
      shootings.push_back(run->front().ShootSeconds);
    }
  }
  const Summary shoot = Summarize(shootings);
  const Table table(stream, shoot.Median);
  table.Write("%-34s %8s %8s %8s %8s %7s  |%6s %6s\n", "Seconds", "mean", "median", "least", "most",
    "ratio", "paper", "ratio");
  table.WriteSeconds("First shooting", shoot, PaperShoot);
  table.WriteSeconds("Verification", SummarizeUpdates(m.Cached, VerifySeconds), PaperVerify);
  if (!m.Uncached.empty())
  {
    table.WriteSeconds("Update, without static-hit cache",
      SummarizeUpdates(m.Uncached, RepairSeconds), PaperUpdateUncached);
  }
  table.WriteSeconds(
    "Update, with static-hit cache", SummarizeUpdates(m.Cached, RepairSeconds), PaperUpdateCached);
  table.WriteSeconds("Verification + update with cache", SummarizeUpdates(m.Cached, UpdateSeconds),
    PaperVerify + PaperUpdateCached);
  table.WritePercent("Walks found invalid", SummarizeUpdates(m.Cached, InvalidPercent));
  table.WritePercent("Path segments shot again", SummarizeUpdates(m.Cached, RepairedPercent));
  table.Write("%-34s %.2f GB at first, %.2f GB at most\n", "Memory of the stored walks",
    m.Cached.front().HistoryBytes / 1e9, MostGigabytes(m.Cached));
}

}
