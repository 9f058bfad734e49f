// SPDX-License-Identifier: BSD-3-Clause
// How often the meshes of random trees are right: trees of every node kind, two to six nodes above
// each other, each made with all four methods of blending. What is wrong with them is counted by
// the rules of tests/support/TreeTrial.h, and so is how many trees had to be judged at a shorter
// edge length since they have parts that are thinner than a cell.
//
//   RandomTreeFuzz [-n trees, default 5000] [-f first seed, default 0]
//     [-c edge lengths along the largest side, default 20] [-v: also tell what a shorter edge
//     length has mended, and where parts are thin]
//
// Returns 1 if anything is wrong in the end.
#include "core/base/Parallel.h"
#include "tests/support/TreeTrial.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

constexpr std::size_t kPoints = 20000;
constexpr std::size_t kTreesAtOnce = 64;

struct Options
{
  std::size_t trees = 5000;
  std::uint64_t first = 0;
  double cells = 20.0;
  bool verbose = false;
};

struct Trial
{
  std::uint64_t seed = 0;
  std::vector<TreeVerdict> verdicts;
  double seconds = 0.0;
};

Trial timedTrial(std::uint64_t seed, double cells)
{
  const auto start = std::chrono::steady_clock::now();
  Trial trial{ seed, tryTree(seed, cells, kPoints) };
  trial.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return trial;
}

class Tally
{
public:
  void add(const Trial& trial, bool verbose)
  {
    const TreeVerdict& first = trial.verdicts.front();
    const TreeVerdict& last = trial.verdicts.back();
    ++trees_;
    meshes_ += first.meshes;
    warned_ += first.warned;
    for (std::size_t fault = 0; fault < kFaults; ++fault)
    {
      atFirst_[fault] += first.count[fault] > 0 ? 1 : 0;
      atLast_[fault] += last.count[fault] > 0 ? 1 : 0;
    }
    bad_ += last.bad() ? 1 : 0;
    const std::size_t level = std::min(trial.verdicts.size() - 1, goodAfter_.size() - 1);
    goodAfter_[level] += last.bad() ? 0 : 1;
    if (last.bad() || (verbose && !first.text.empty()))
    {
      std::printf("seed %llu (%.2f s)%s\n%s", static_cast<unsigned long long>(trial.seed),
        trial.seconds, last.bad() ? "" : ", good in the end",
        (last.bad() ? last : first).text.c_str());
      std::fflush(stdout);
    }
  }

  bool allGood() const { return bad_ == 0; }

  void printLine() const
  {
    std::printf("%d trees, %d bad, %d disagree at thin parts\n", trees_, bad_,
      atLast_[std::size_t(Fault::ThinApart)]);
    std::fflush(stdout);
  }

  void print() const
  {
    std::printf("\n%d trees, %d meshes; %d of them with a warning\n", trees_, meshes_, warned_);
    std::printf("%-24s %10s %12s\n", "trees", "at first", "in the end");
    for (std::size_t fault = 0; fault < kFaults; ++fault)
    {
      std::printf("%-24s %10d %12d\n", kFaultNames[fault], atFirst_[fault], atLast_[fault]);
    }
    std::printf("good at the first edge length %d, at a half %d, at a quarter %d, at an eighth %d, "
                "never %d\n",
      goodAfter_[0], goodAfter_[1], goodAfter_[2], goodAfter_[3], bad_);
  }

private:
  int trees_ = 0;
  int meshes_ = 0;
  int warned_ = 0;
  int bad_ = 0;
  std::array<int, 4> goodAfter_{};
  std::array<int, kFaults> atFirst_{};
  std::array<int, kFaults> atLast_{};
};

Options optionsFrom(int argc, char** argv)
{
  Options options;
  for (int c; (c = getopt(argc, argv, "n:f:c:v")) != -1;)
  {
    switch (c)
    {
      case 'n':
        options.trees = std::strtoull(optarg, nullptr, 10);
        break;
      case 'f':
        options.first = std::strtoull(optarg, nullptr, 10);
        break;
      case 'c':
        options.cells = std::atof(optarg);
        break;
      case 'v':
        options.verbose = true;
        break;
      default:
        std::exit(2);
    }
  }
  return options;
}

} // namespace

int main(int argc, char** argv)
{
  const Options options = optionsFrom(argc, argv);
  Tally tally;
  for (std::size_t begin = 0; begin < options.trees; begin += kTreesAtOnce)
  {
    std::vector<Trial> trials(std::min(kTreesAtOnce, options.trees - begin));
    parallelFor(trials.size(), 1,
      [&](std::size_t from, std::size_t to)
      {
        for (std::size_t k = from; k < to; ++k)
        {
          trials[k] = timedTrial(options.first + begin + k, options.cells);
        }
      });
    for (const Trial& trial : trials)
    {
      tally.add(trial, options.verbose);
    }
    tally.printLine();
  }
  tally.print();
  return tally.allGood() ? 0 : 1;
}
