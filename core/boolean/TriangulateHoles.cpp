// SPDX-License-Identifier: BSD-3-Clause
// The part of Triangulator that joins holes to the polygon around them.
#include "core/boolean/Triangulate.h"

#include "core/geometry/Predicates.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kSpike = 0x1p-40; // angle

} // namespace

// Whether no side of the loops passes between two points.
bool Triangulator::isVisible(
  std::int32_t from, std::int32_t to, const std::vector<Loop>& loops) const
{
  const auto blocks = [&](std::int32_t a, std::int32_t b)
  {
    if (a == from || b == from || a == to || b == to)
    {
      // A side that leaves along the way.
      const std::int32_t far = a == from || a == to ? b : a;
      const std::int32_t shared = far == b ? a : b;
      if (far == from || far == to || this->turn(from, to, far) != 0)
      {
        return false;
      }
      const PlanarPoint& p = (*points_)[std::size_t(shared)];
      const PlanarPoint& q = (*points_)[std::size_t(far)];
      const PlanarPoint& r = (*points_)[std::size_t(shared == from ? to : from)];
      return (q.x - p.x) * (r.x - p.x) + (q.y - p.y) * (r.y - p.y) > 0.0;
    }
    return this->turn(a, b, from) * this->turn(a, b, to) <= 0 &&
      this->turn(from, to, a) * this->turn(from, to, b) <= 0;
  };
  for (const Loop& loop : loops)
  {
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      if (blocks(loop[k], loop[(k + 1) % loop.size()]))
      {
        return false;
      }
    }
  }
  return true;
}

// Whether no side passes between two points beyond doubt; one that touches the way may.
bool Triangulator::isOpen(std::int32_t from, std::int32_t to, const std::vector<Loop>& loops) const
{
  const auto blocks = [&](std::int32_t a, std::int32_t b)
  {
    return this->turn(a, b, from) * this->turn(a, b, to) < 0 &&
      this->turn(from, to, a) * this->turn(from, to, b) < 0;
  };
  for (const Loop& loop : loops)
  {
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      if (blocks(loop[k], loop[(k + 1) % loop.size()]))
      {
        return false;
      }
    }
  }
  return true;
}

// Where a hole lies as seen from one of its points: in the middle between its sides there.
PlanarPoint Triangulator::inwardOf(const Loop& hole, std::size_t h) const
{
  const PlanarPoint& at = (*points_)[std::size_t(hole[h])];
  const PlanarPoint& p = this->leaving(hole, h, hole.size() - 1);
  const PlanarPoint& q = this->leaving(hole, h, 1);
  const double x = 0.5 * (p.x + q.x) - at.x;
  const double y = 0.5 * (p.y + q.y) - at.y;
  const double sign = orientation2d(p.x, p.y, at.x, at.y, q.x, q.y) > 0 ? -1.0 : 1.0;
  return { at.x + sign * x, at.y + sign * y, 0 };
}

// The next point of a loop that is somewhere else, in steps from one of them.
const PlanarPoint& Triangulator::leaving(const Loop& loop, std::size_t from, std::size_t step) const
{
  const auto at = [&](std::size_t k) -> const PlanarPoint&
  { return (*points_)[std::size_t(loop[k])]; };
  std::size_t k = (from + step) % loop.size();
  while (k != from && squaredDistance(at(k), at(from)) == 0.0)
  {
    k = (k + step) % loop.size();
  }
  return at(k);
}

// Whether a hole lies where the polygon is, as seen from a point of it: where holes share a point
// with the polygon, their order around it tells.
bool Triangulator::isAround(std::size_t k, const Loop& hole, std::size_t h) const
{
  const PlanarPoint& at = (*points_)[std::size_t(polygon_[k])];
  const PlanarPoint& from = (*points_)[std::size_t(hole[h])];
  const PlanarPoint target = squaredDistance(at, from) == 0.0 ? this->inwardOf(hole, h) : from;
  const PlanarPoint& before = this->leaving(polygon_, k, polygon_.size() - 1);
  const PlanarPoint& after = this->leaving(polygon_, k, 1);
  const auto turns = [](const PlanarPoint& p, const PlanarPoint& q, const PlanarPoint& r)
  { return orientation2d(p.x, p.y, q.x, q.y, r.x, r.y); };
  const bool left = turns(before, at, target) > 0;
  const bool right = turns(at, after, target) > 0;
  const double x = before.x - at.x;
  const double y = before.y - at.y;
  const double along = x * (after.x - at.x) + y * (after.y - at.y);
  const double across = x * (after.y - at.y) - y * (after.x - at.x);
  const bool isSpike = along > 0.0 && std::abs(across) <= kSpike * along;
  return isSpike || turns(before, at, after) >= 0 ? left && right : left || right;
}

// The shortest way from any point of a hole that rounding has made touch other loops: its place in
// the hole and in the polygon.
std::optional<Triangulator::Way> Triangulator::anyWay(
  const Loop& hole, const std::vector<Loop>& walls) const
{
  std::vector<std::pair<std::pair<bool, double>, Way>> ways;
  for (std::size_t h = 0; h < hole.size(); ++h)
  {
    for (std::size_t k = 0; k < polygon_.size(); ++k)
    {
      if (this->mayJoin(hole[h], polygon_[k]))
      {
        const bool isAround = this->isAround(k, hole, h);
        const double length =
          squaredDistance((*points_)[std::size_t(hole[h])], (*points_)[std::size_t(polygon_[k])]);
        ways.push_back({ { !isAround, length }, { h, k } });
      }
    }
  }
  std::sort(ways.begin(), ways.end());
  const auto open = std::find_if(ways.begin(), ways.end(),
    [&](const std::pair<std::pair<bool, double>, Way>& way)
    { return this->isOpen(hole[way.second[0]], polygon_[way.second[1]], walls); });
  return ways.empty() ? std::optional<Way>() : (open == ways.end() ? ways.front() : *open).second;
}

// Joins the holes to the outer loop, the rightmost first, each by the shortest way that is free.
bool Triangulator::bridge(const std::vector<Loop>& loops)
{
  polygon_ = loops.front();
  const auto x = [&](std::int32_t p) { return (*points_)[std::size_t(p)].x; };
  std::vector<std::pair<double, std::size_t>> order;
  std::vector<std::size_t> rightmost(loops.size());
  for (std::size_t hole = 1; hole < loops.size(); ++hole)
  {
    const Loop& loop = loops[hole];
    const auto most = std::max_element(
      loop.begin(), loop.end(), [&](std::int32_t a, std::int32_t b) { return x(a) < x(b); });
    rightmost[hole] = std::size_t(most - loop.begin());
    order.emplace_back(-x(*most), hole);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [minusX, hole] : order)
  {
    const Loop& loop = loops[hole];
    const std::int32_t from = loop[rightmost[hole]];
    std::vector<std::pair<double, std::size_t>> ways;
    for (std::size_t k = 0; k < polygon_.size(); ++k)
    {
      ways.emplace_back(
        squaredDistance((*points_)[std::size_t(from)], (*points_)[std::size_t(polygon_[k])]), k);
    }
    std::sort(ways.begin(), ways.end());
    std::vector<Loop> walls = loops;
    walls.push_back(polygon_);
    const auto free = std::find_if(ways.begin(), ways.end(),
      [&](const std::pair<double, std::size_t>& way)
      {
        const std::size_t k = way.second;
        const std::size_t count = polygon_.size();
        // At a point met twice, from the side that the hole lies on.
        const std::int32_t at = polygon_[k];
        const std::int32_t before = polygon_[(k + count - 1) % count];
        const std::int32_t after = polygon_[(k + 1) % count];
        const bool convex = this->turn(before, at, after) > 0;
        const bool left = this->turn(before, at, from) > 0;
        const bool right = this->turn(at, after, from) > 0;
        return (convex ? left && right : left || right) && this->mayJoin(from, at) &&
          this->isVisible(from, at, walls);
      });
    const std::optional<Way> way = free == ways.end()
      ? this->anyWay(loop, walls)
      : std::optional<Way>({ rightmost[hole], free->second });
    if (!way)
    {
      return false;
    }
    const auto [start, end] = *way;
    Loop detour{ polygon_[end] };
    for (std::size_t k = 0; k <= loop.size(); ++k)
    {
      detour.push_back(loop[(start + k) % loop.size()]);
    }
    polygon_.insert(polygon_.begin() + std::ptrdiff_t(end), detour.begin(), detour.end());
  }
  return true;
}

} // namespace hybridtree
