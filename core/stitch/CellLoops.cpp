// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellLoops.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

// A diagonal in a face is worse than any shape.
constexpr double kInFace = 1e3;

double badness(const Vec3& a, const Vec3& b, const Vec3& c)
{
  double squared[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
  std::sort(squared, squared + 3);
  const double scale = 2.0 * std::sqrt(squared[1] * squared[2]);
  const double cosine = scale > 0.0 ? (squared[1] + squared[2] - squared[0]) / scale : 1.0;
  const double positive = std::max(cosine, 0.0);
  const double fourth = positive * positive * positive * positive;
  return fourth * fourth;
}

/// Dynamic programming over all triangulations (Klincsek 1980).
class LoopFiller
{
public:
  LoopFiller(const CellLoop& loop, std::vector<Triangle>& triangles)
    : loop_(loop)
    , triangles_(triangles)
    , cost_(loop.size() * loop.size(), 0.0)
    , split_(loop.size() * loop.size(), 0)
  {
  }

  bool fill()
  {
    const std::size_t n = loop_.size();
    for (std::size_t length = 2; length < n; ++length)
    {
      for (std::size_t i = 0; i + length < n; ++i)
      {
        this->solve(i, i + length);
      }
    }
    const bool filled = cost_[n - 1] < kInFace;
    if (filled)
    {
      this->collect(0, n - 1);
    }
    return filled;
  }

private:
  void solve(std::size_t i, std::size_t j)
  {
    const std::size_t n = loop_.size();
    const bool isSide = i == 0 && j + 1 == n;
    const double own = !isSide && (loop_[i].faces & loop_[j].faces) != 0 ? kInFace : 0.0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < j; ++k)
    {
      const double cost = cost_[i * n + k] + cost_[k * n + j] + own +
        badness(loop_[i].point, loop_[k].point, loop_[j].point);
      if (cost < best)
      {
        best = cost;
        split_[i * n + j] = k;
      }
    }
    cost_[i * n + j] = best;
  }

  void collect(std::size_t i, std::size_t j)
  {
    if (j < i + 2)
    {
      return;
    }
    const std::size_t k = split_[i * loop_.size() + j];
    triangles_.push_back({ loop_[i].vertex, loop_[k].vertex, loop_[j].vertex });
    this->collect(i, k);
    this->collect(k, j);
  }

  const CellLoop& loop_;
  std::vector<Triangle>& triangles_;
  std::vector<double> cost_;
  std::vector<std::size_t> split_;
};

} // namespace

bool joinSegments(const std::vector<CellSegment>& segments, std::vector<CellLoop>& loops)
{
  loops.clear();
  std::vector<std::size_t> order(segments.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    order[k] = k;
  }
  const auto start = [&](std::size_t k) { return segments[k].from.vertex; };
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return start(a) < start(b); });
  bool good = true;
  std::vector<bool> done(segments.size(), false);
  for (std::size_t first = 0; first < order.size(); ++first)
  {
    if (done[first])
    {
      continue;
    }
    CellLoop loop;
    std::size_t k = first;
    while (k < order.size() && !done[k])
    {
      done[k] = true;
      const CellSegment& segment = segments[order[k]];
      loop.push_back(segment.from);
      const auto next = std::lower_bound(order.begin(), order.end(), segment.to.vertex,
        [&](std::size_t n, std::int32_t vertex) { return start(n) < vertex; });
      k = static_cast<std::size_t>(next - order.begin());
      if (k < order.size() && start(order[k]) != segment.to.vertex)
      {
        k = order.size();
      }
    }
    if (k != first)
    {
      good = false;
      continue;
    }
    loops.push_back(std::move(loop));
  }
  return good;
}

bool fillLoop(const CellLoop& loop, std::vector<Triangle>& triangles)
{
  return loop.size() < 3 || LoopFiller(loop, triangles).fill();
}

} // namespace hybridtree
