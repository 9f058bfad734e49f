// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/LimbRanges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// A number that counts as much as its weight, which is within bounds.
struct Weighed
{
  double number;
  Interval weight;
};

// The largest mean: the largest numbers weigh most, the others least.
double largestMean(std::vector<Weighed>& all)
{
  std::sort(
    all.begin(), all.end(), [](const Weighed& a, const Weighed& b) { return a.number > b.number; });
  double weights = 0.0;
  double sum = 0.0;
  for (const Weighed& of : all)
  {
    weights += of.weight.min;
    sum += of.weight.min * of.number;
  }
  double most = weights > 0.0 ? sum / weights : -std::numeric_limits<double>::infinity();
  for (const Weighed& of : all)
  {
    const double more = of.weight.max - of.weight.min;
    weights += more;
    sum += more * of.number;
    if (weights > 0.0)
    {
      most = std::max(most, sum / weights);
    }
  }
  return most;
}

} // namespace

Interval LimbRanges::product(PieceRows rows, std::uint32_t piece) const
{
  Interval sum{ 0.0, 0.0 };
  for (std::uint32_t k = rows.begin[piece]; k < rows.begin[piece + 1]; ++k)
  {
    const auto& [other, weight] = rows.weights[k];
    sum.min += weight * fields_[other].min;
    sum.max += weight * fields_[other].max;
  }
  return sum;
}

Interval LimbRanges::mean(const std::uint32_t* centers, std::size_t count) const
{
  std::vector<Interval> sights(count);
  double most = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    sights[k] = fields_[centers[k]].max > 0.0 ? this->product(sights_, centers[k]) : Interval{};
    most = std::max(most, sights[k].max);
  }
  std::vector<Weighed> least;
  std::vector<Weighed> largest;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Interval& own = fields_[centers[k]];
    if (own.max > 0.0)
    {
      const Interval weight{ own.min * std::pow(sights[k].min / most, 20),
        own.max * std::pow(sights[k].max / most, 20) };
      const Interval shared = this->product(shares_, centers[k]);
      least.push_back({ -shared.min, weight });
      largest.push_back({ shared.max, weight });
    }
  }
  return largest.empty() ? Interval{ 0.0, 0.0 }
                         : Interval{ -largestMean(least), largestMean(largest) };
}

Interval localLimbRange(
  const ConvolutionField& whole, const BlendSelection& selection, const Box3& box)
{
  const Interval sum = whole.range(selection.all, box);
  if (sum.max <= 0.0)
  {
    return sum;
  }
  const BlendSelection::Limbs& limbs = selection.limbs;
  std::vector<Interval> fields;
  fields.reserve(limbs.pieces.size());
  for (std::size_t k = 0; k < limbs.pieces.size(); ++k)
  {
    ElementSpans elements;
    const auto span = [](const auto& all, const std::vector<std::uint32_t>& begin, std::size_t k,
                        auto& of) {
      of = { all.data() + begin[k], begin[k + 1] - begin[k] };
    };
    if (k < limbs.ofSegments)
    {
      span(limbs.segments, limbs.segmentsBegin, k, elements.segments);
    }
    else
    {
      span(limbs.triangles, limbs.trianglesBegin, k - limbs.ofSegments, elements.triangles);
    }
    fields.push_back(whole.range(elements, box));
  }
  std::vector<std::uint32_t> centers(fields.size());
  std::iota(centers.begin(), centers.end(), 0u);
  const Interval loss = LimbRanges(fields, { limbs.sightsBegin.data(), limbs.sights.data() },
    { limbs.sharesBegin.data(), limbs.shares.data() })
                          .mean(centers.data(), centers.size());
  const double rounding = 1e-13 * (1.0 + sum.max);
  return { std::max(0.0, sum.min - loss.max - rounding),
    std::min(sum.max, sum.max - loss.min + rounding) };
}

} // namespace hybridtree
