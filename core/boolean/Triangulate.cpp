// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/Triangulate.h"

#include "core/geometry/Predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kNone = std::size_t(-1);
constexpr std::size_t kSmall = 12; // up to here the best ear is looked for
constexpr int kFlipsPerEdge = 10;

using Side = std::pair<std::int32_t, std::int32_t>;

double squaredDistance(const PlanarPoint& a, const PlanarPoint& b)
{
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Area over the sum of squared sides: largest for the equilateral, 0 for a flat one.
double shapeOf(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c)
{
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const double sides = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  return sides > 0.0 ? area / sides : 0.0;
}

bool isSamePlace(const PlanarPoint& a, const PlanarPoint& b)
{
  return a.x == b.x && a.y == b.y;
}

} // namespace

int Triangulator::turn(std::int32_t a, std::int32_t b, std::int32_t c) const
{
  const PlanarPoint& p = (*points_)[std::size_t(a)];
  const PlanarPoint& q = (*points_)[std::size_t(b)];
  const PlanarPoint& r = (*points_)[std::size_t(c)];
  return orientation2d(p.x, p.y, q.x, q.y, r.x, r.y);
}

bool Triangulator::mayJoin(std::int32_t a, std::int32_t b) const
{
  return a != b && ((*points_)[std::size_t(a)].edges & (*points_)[std::size_t(b)].edges) == 0;
}

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
    if (free == ways.end())
    {
      return false;
    }
    Loop detour{ polygon_[free->second] };
    for (std::size_t k = 0; k <= loop.size(); ++k)
    {
      detour.push_back(loop[(rightmost[hole] + k) % loop.size()]);
    }
    polygon_.insert(polygon_.begin() + std::ptrdiff_t(free->second), detour.begin(), detour.end());
  }
  return true;
}

double Triangulator::shape(std::size_t tip) const
{
  return shapeOf((*points_)[std::size_t(polygon_[previous_[tip]])],
    (*points_)[std::size_t(polygon_[tip])], (*points_)[std::size_t(polygon_[next_[tip]])]);
}

bool Triangulator::isEar(std::size_t tip) const
{
  const std::int32_t a = polygon_[previous_[tip]];
  const std::int32_t b = polygon_[tip];
  const std::int32_t c = polygon_[next_[tip]];
  if ((left_ > 3 && !this->mayJoin(a, c)) || this->turn(a, b, c) <= 0)
  {
    return false;
  }
  const PlanarPoint& p = (*points_)[std::size_t(a)];
  const PlanarPoint& q = (*points_)[std::size_t(b)];
  const PlanarPoint& r = (*points_)[std::size_t(c)];
  const auto [left, right] = std::minmax({ p.x, q.x, r.x });
  const auto [low, high] = std::minmax({ p.y, q.y, r.y });
  for (std::size_t k = next_[next_[tip]]; k != previous_[tip]; k = next_[k])
  {
    const std::int32_t other = polygon_[k];
    const PlanarPoint& s = (*points_)[std::size_t(other)];
    if (s.x < left || s.x > right || s.y < low || s.y > high || isSamePlace(s, p) ||
      isSamePlace(s, q) || isSamePlace(s, r))
    {
      continue;
    }
    if (this->turn(a, b, other) >= 0 && this->turn(b, c, other) >= 0 &&
      this->turn(c, a, other) >= 0)
    {
      return false;
    }
  }
  return true;
}

std::size_t Triangulator::chooseSmall() const
{
  std::size_t best = kNone;
  double most = -1.0;
  std::size_t tip = at_;
  for (std::size_t k = 0; k < left_; ++k, tip = next_[tip])
  {
    const double shape = this->shape(tip);
    if (shape > most && this->isEar(tip))
    {
      most = shape;
      best = tip;
    }
  }
  return best;
}

std::size_t Triangulator::chooseLarge(std::size_t from) const
{
  std::size_t tip = from;
  for (std::size_t k = 0; k < left_; ++k, tip = next_[tip])
  {
    if (this->isEar(tip))
    {
      return tip;
    }
  }
  return kNone;
}

// The polygon has no ear: rounding has folded it. The least evil one.
std::size_t Triangulator::chooseAny() const
{
  std::size_t best = kNone;
  double most = -std::numeric_limits<double>::infinity();
  std::size_t tip = at_;
  for (std::size_t k = 0; k < left_; ++k, tip = next_[tip])
  {
    const double shape = this->shape(tip);
    if ((left_ == 3 || this->mayJoin(polygon_[previous_[tip]], polygon_[next_[tip]])) &&
      shape > most)
    {
      most = shape;
      best = tip;
    }
  }
  return best;
}

bool Triangulator::clip()
{
  const std::size_t count = polygon_.size();
  next_.resize(count);
  previous_.resize(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    next_[k] = (k + 1) % count;
    previous_[k] = (k + count - 1) % count;
  }
  at_ = 0;
  proper_ = true;
  for (left_ = count; left_ >= 3; --left_)
  {
    std::size_t tip = left_ <= kSmall ? this->chooseSmall() : this->chooseLarge(at_);
    if (tip == kNone)
    {
      proper_ = false;
      tip = this->chooseAny();
    }
    if (tip == kNone)
    {
      return false;
    }
    made_.push_back({ polygon_[previous_[tip]], polygon_[tip], polygon_[next_[tip]] });
    next_[previous_[tip]] = next_[tip];
    previous_[next_[tip]] = previous_[tip];
    at_ = next_[next_[tip]]; // a step on, or all ears would meet in one point
  }
  return true;
}

bool Triangulator::hasRepeatedEdges() const
{
  std::vector<Side> sides;
  for (const Triangle& corner : made_)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      sides.emplace_back(corner[k], corner[(k + 1) % 3]);
      if (corner[k] == corner[(k + 1) % 3])
      {
        return true;
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  return std::adjacent_find(sides.begin(), sides.end()) != sides.end();
}

// The smaller shape of the triangles left and right of a diagonal.
double Triangulator::worstOf(
  std::int32_t a, std::int32_t b, std::int32_t left, std::int32_t right) const
{
  const auto at = [&](std::int32_t p) { return (*points_)[std::size_t(p)]; };
  return std::min(shapeOf(at(a), at(b), at(left)), shapeOf(at(b), at(a), at(right)));
}

// Flips the edge a b between t, which runs along it, and u, where both triangles become better.
bool Triangulator::flip(std::size_t t, std::size_t u, std::int32_t a, std::int32_t b)
{
  const auto apex = [&](std::size_t triangle)
  {
    return *std::find_if(made_[triangle].begin(), made_[triangle].end(),
      [&](std::int32_t p) { return p != a && p != b; });
  };
  const std::int32_t c = apex(t);
  const std::int32_t d = apex(u);
  if (!this->mayJoin(c, d) || this->turn(c, a, d) <= 0 || this->turn(d, b, c) <= 0 ||
    this->worstOf(d, c, a, b) <= this->worstOf(a, b, c, d) * (1.0 + 1e-9))
  {
    return false;
  }
  made_[t] = { c, a, d };
  made_[u] = { d, b, c };
  return true;
}

// Flips among few triangles, by trying all.
void Triangulator::improveSmall()
{
  const auto runsAlong = [&](std::size_t t, std::int32_t a, std::int32_t b)
  {
    const Triangle& c = made_[t];
    return (c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b);
  };
  bool changed = true;
  for (std::size_t round = 0; round < made_.size() && changed; ++round)
  {
    changed = false;
    for (std::size_t t = 0; t < made_.size(); ++t)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int32_t a = made_[t][k];
        const std::int32_t b = made_[t][(k + 1) % 3];
        std::size_t u = t + 1;
        while (u < made_.size() && !runsAlong(u, b, a))
        {
          ++u;
        }
        changed = (u < made_.size() && this->flip(t, u, a, b)) || changed;
      }
    }
  }
}

// Lawson's flips, away from edges that are sides of the polygon.
void Triangulator::improveLarge()
{
  std::map<Side, std::size_t> triangleOf; // per half-edge
  std::vector<Side> stack;
  const auto enter = [&](std::size_t t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      triangleOf[{ made_[t][k], made_[t][(k + 1) % 3] }] = t;
      stack.emplace_back(made_[t][k], made_[t][(k + 1) % 3]);
    }
  };
  for (std::size_t t = 0; t < made_.size(); ++t)
  {
    enter(t);
  }
  std::size_t budget = kFlipsPerEdge * stack.size();
  while (!stack.empty() && budget-- > 0)
  {
    const auto [a, b] = stack.back();
    stack.pop_back();
    const auto here = triangleOf.find({ a, b });
    const auto there = triangleOf.find({ b, a });
    if (here == triangleOf.end() || there == triangleOf.end())
    {
      continue;
    }
    const std::size_t t = here->second;
    const std::size_t u = there->second;
    if (this->flip(t, u, a, b))
    {
      triangleOf.erase(here);
      triangleOf.erase({ b, a });
      enter(t);
      enter(u);
    }
  }
}

bool Triangulator::triangulate(const std::vector<PlanarPoint>& points,
  const std::vector<Loop>& loops, std::vector<Triangle>& triangles)
{
  points_ = &points;
  made_.clear();
  if (loops.size() == 1)
  {
    polygon_ = loops.front();
  }
  else if (!this->bridge(loops))
  {
    return false;
  }
  if (!this->clip() || (loops.size() > 1 && this->hasRepeatedEdges()))
  {
    return false;
  }
  if (proper_ && made_.size() > 1)
  {
    polygon_.size() > kSmall ? this->improveLarge() : this->improveSmall();
  }
  triangles.insert(triangles.end(), made_.begin(), made_.end());
  return true;
}

} // namespace hybridtree
