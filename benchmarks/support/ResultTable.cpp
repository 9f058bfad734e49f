// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/ResultTable.h"

#include <cstdio>

namespace benchmarks
{

void ResultTable::add(const std::string& shape, const std::string& method,
  const std::string& benchmark, const MeshQuality& quality)
{
  rows_.push_back({ shape, method, benchmark, quality, 0.0 });
}

void ResultTable::setTime(const std::string& benchmark, double milliseconds)
{
  for (Row& row : rows_)
  {
    row.milliseconds = row.benchmark == benchmark ? milliseconds : row.milliseconds;
  }
}

void ResultTable::print() const
{
  std::printf(
    "\n| shape | method | ms | times the first | triangles | count | least angle | below 25 "
    "| aspect |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n");
  const Row* first = nullptr;
  for (const Row& row : rows_)
  {
    if (row.milliseconds == 0.0)
    {
      continue;
    }
    const bool starts = !first || first->shape != row.shape;
    first = starts ? &row : first;
    const MeshQuality& q = row.quality;
    // Error goes with 1 / triangles: what the first would need for the error of this one.
    const double count =
      first->quality.error * double(first->quality.triangles) / (q.error * double(q.triangles));
    std::printf("| %s | %s | %.3f | %.1f | %zu | %.2f | %.1f | %.1f %% | %.2f |\n",
      starts ? row.shape.c_str() : "", row.method.c_str(), row.milliseconds,
      row.milliseconds / first->milliseconds, q.triangles, count, q.meanLeast, 100.0 * q.below25,
      q.aspectRatio);
  }
}

void TableReporter::ReportRuns(const std::vector<Run>& runs)
{
  for (const Run& run : runs)
  {
    table_.setTime(run.benchmark_name(), run.GetAdjustedCPUTime());
  }
  benchmark::ConsoleReporter::ReportRuns(runs);
}

} // namespace benchmarks
