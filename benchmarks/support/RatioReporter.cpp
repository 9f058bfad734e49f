// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/RatioReporter.h"

#include <algorithm>
#include <cstdio>

namespace benchmarks
{
namespace
{

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

RatioReporter::Row& RatioReporter::row(const std::string& name)
{
  const auto found =
    std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
  return found != rows_.end() ? *found : rows_.emplace_back(Row{ name, {}, {}, "" });
}

void RatioReporter::list(const std::string& name)
{
  this->row(name);
}

void RatioReporter::ReportRuns(const std::vector<Run>& runs)
{
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs)
  {
    if (run.run_type != Run::RT_Iteration || run.error_occurred)
    {
      continue;
    }
    Row& row = this->row(run.run_name.function_name);
    row.unit = benchmark::GetTimeUnitString(run.time_unit);
    row.wall.push_back(run.GetAdjustedRealTime());
    row.cpu.push_back(run.GetAdjustedCPUTime());
  }
}

void RatioReporter::print() const
{
  std::printf("\n| case | method | time | times the first |%s\n|---|---|---:|---:|%s\n",
    withCpu_ ? " CPU time | times the first |" : "", withCpu_ ? "---:|---:|" : "");
  std::string last;
  double wall = 0.0;
  double cpu = 0.0;
  for (const Row& row : rows_)
  {
    if (row.wall.empty())
    {
      continue;
    }
    const std::size_t slash = row.name.rfind('/');
    const std::string name = row.name.substr(0, slash);
    const double rowWall = median(row.wall);
    const double rowCpu = median(row.cpu);
    if (name != last)
    {
      wall = rowWall;
      cpu = rowCpu;
    }
    std::printf("| %s | %s | %.3f %s | %.2f |", name == last ? "" : name.c_str(),
      row.name.substr(slash + 1).c_str(), rowWall, row.unit.c_str(), rowWall / wall);
    if (withCpu_)
    {
      std::printf(" %.3f %s | %.2f |", rowCpu, row.unit.c_str(), rowCpu / cpu);
    }
    std::printf("\n");
    last = name;
  }
}

void initializeInterleaved(int argc, char** argv, int repetitions)
{
  // Google Benchmark keeps a pointer to the first.
  static std::vector<std::string> words;
  words = { argv[0], "--benchmark_repetitions=" + std::to_string(repetitions),
    "--benchmark_enable_random_interleaving=true" };
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> pointers;
  for (std::string& word : words)
  {
    pointers.push_back(word.data());
  }
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data());
}

} // namespace benchmarks
