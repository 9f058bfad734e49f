// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmarks/support/MeshQuality.h"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace benchmarks
{

/// The results of one run side by side: methods of making each shape, compared with the first.
class ResultTable
{
public:
  void add(const std::string& shape, const std::string& method, const std::string& benchmark,
    const MeshQuality& quality);
  void setTime(const std::string& benchmark, double milliseconds);

  /// As Markdown; shapes that have not been run are left out.
  void print() const;

private:
  struct Row
  {
    std::string shape;
    std::string method;
    std::string benchmark;
    MeshQuality quality;
    double milliseconds = 0.0;
  };
  std::vector<Row> rows_;
};

/// Prints as usual, and keeps the CPU times for the table.
class TableReporter final : public benchmark::ConsoleReporter
{
public:
  explicit TableReporter(ResultTable& table) : table_(table) {}
  void ReportRuns(const std::vector<Run>& runs) override;

private:
  ResultTable& table_;
};

} // namespace benchmarks
