// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace benchmarks
{

/// Compares benchmarks named "<case>/<method>": prints as usual, and keeps wall and CPU times of
/// all repetitions for a table of their medians.
class RatioReporter final : public benchmark::ConsoleReporter
{
public:
  /// \param withCpu off where the time that counts is measured by the benchmark itself.
  explicit RatioReporter(bool withCpu = true) : withCpu_(withCpu) {}

  /// Rows are in the order in which they are listed; all others follow. Methods of a case together.
  void list(const std::string& name);

  void ReportRuns(const std::vector<Run>& runs) override;

  /// As Markdown: each method of a case as a multiple of the case's first. What has not run is left
  /// out.
  void print() const;

private:
  struct Row
  {
    std::string name;
    std::vector<double> wall; // in the unit of the benchmark
    std::vector<double> cpu;
    std::string unit;
  };
  Row& row(const std::string& name);

  bool withCpu_;
  std::vector<Row> rows_;
};

/// Initialises Google Benchmark with so many repetitions of all benchmarks in random order, which
/// the command line may overrule: what disturbs the machine then disturbs all alike.
void initializeInterleaved(int argc, char** argv, int repetitions);

} // namespace benchmarks
