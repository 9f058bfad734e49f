// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeRangedArray.h"

#include "core/base/Parallel.h"

#include <array>
#include <limits>
#include <mutex>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1 << 15; // tuples: fewer are not worth a second thread
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Range
{
  double least = kInfinity;
  double most = -kInfinity;

  void add(double value)
  {
    least = std::min(least, value);
    most = std::max(most, value);
  }

  void add(const Range& other)
  {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
};

template <std::size_t Components>
struct TupleRanges
{
  std::array<Range, Components> components;
  Range squares;
  double zero = 0.0; ///< as long as all is finite, else not a number

  template <class Value>
  void add(const Value* tuple)
  {
    double sum = 0.0;
    for (std::size_t c = 0; c < Components; ++c)
    {
      const auto value = static_cast<double>(tuple[c]);
      components[c].add(value);
      sum += value * value;
    }
    squares.add(sum);
    zero += 0.0 * sum;
  }

  void add(const TupleRanges& other)
  {
    for (std::size_t c = 0; c < Components; ++c)
    {
      components[c].add(other.components[c]);
    }
    squares.add(other.squares);
    zero += other.zero;
  }
};

// The number of components is a constant for the compiler: twice as fast.
template <std::size_t Components, class Value>
std::optional<ArrayRanges> find(const Value* values, std::size_t tuples)
{
  TupleRanges<Components> all;
  std::mutex mutex;
  parallelFor(tuples, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      TupleRanges<Components> part;
      for (std::size_t t = begin; t < end; ++t)
      {
        part.add(values + Components * t);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      all.add(part);
    });
  if (all.zero != 0.0)
  {
    return std::nullopt;
  }
  ArrayRanges ranges{ {}, { all.squares.least, all.squares.most } };
  for (const Range& range : all.components)
  {
    ranges.components.insert(ranges.components.end(), { range.least, range.most });
  }
  return ranges;
}

template <class Value>
std::optional<ArrayRanges> find(const Value* values, int components, vtkIdType tuples)
{
  const auto count = static_cast<std::size_t>(tuples);
  switch (components)
  {
    case 1:
      return find<1>(values, count);
    case 3:
      return find<3>(values, count);
    default:
      return std::nullopt;
  }
}

} // namespace

std::optional<ArrayRanges> rangesOf(const double* values, int components, vtkIdType tuples)
{
  return find(values, components, tuples);
}

std::optional<ArrayRanges> rangesOf(const vtkTypeInt32* values, int components, vtkIdType tuples)
{
  return find(values, components, tuples);
}

} // namespace hybridtree
