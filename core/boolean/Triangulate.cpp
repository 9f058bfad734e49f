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
constexpr double kTolerance = 0x1p-46;

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

// Whether a diagonal may be made: where bridges lead to holes the same one could come up twice.
bool Triangulator::mayClip(std::int32_t a, std::int32_t c) const
{
  return left_ == 3 ||
    (this->mayJoin(a, c) && (diagonals_.empty() || diagonals_.count(std::minmax(a, c)) == 0));
}

double Triangulator::shape(std::size_t tip) const
{
  return shapeOf((*points_)[std::size_t(polygon_[previous_[tip]])],
    (*points_)[std::size_t(polygon_[tip])], (*points_)[std::size_t(polygon_[next_[tip]])]);
}

bool Triangulator::isEar(std::size_t tip) const
{
  const auto [a, b, c] = this->cornersAt(tip);
  if (!this->mayClip(a, c) || this->turn(a, b, c) <= 0)
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

Triangle Triangulator::cornersAt(std::size_t tip) const
{
  return { polygon_[previous_[tip]], polygon_[tip], polygon_[next_[tip]] };
}

// How far a point lies left of the way from one to the other.
double Triangulator::offset(std::int32_t from, std::int32_t to, std::int32_t point) const
{
  const PlanarPoint& p = (*points_)[std::size_t(from)];
  const PlanarPoint& q = (*points_)[std::size_t(to)];
  const PlanarPoint& r = (*points_)[std::size_t(point)];
  const double length = std::sqrt(squaredDistance(p, q));
  return length > 0.0 ? ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / length : 0.0;
}

// What clipping a tip does to the rest, when rounding has folded the polygon.
Triangulator::Harm Triangulator::harmOf(std::size_t tip) const
{
  const auto [a, b, c] = this->cornersAt(tip);
  if (!this->mayClip(a, c))
  {
    return Harm::Forbidden;
  }
  const double tolerance = this->tolerance();
  const double height =
    std::min({ this->offset(a, b, c), this->offset(b, c, a), this->offset(c, a, b) });
  if (std::abs(height) <= tolerance)
  {
    return Harm::Flat;
  }
  if (height < 0.0)
  {
    return Harm::Overlap;
  }
  for (std::size_t k = next_[next_[tip]]; k != previous_[tip]; k = next_[k])
  {
    const std::int32_t other = polygon_[k];
    if (this->offset(a, b, other) > tolerance && this->offset(b, c, other) > tolerance &&
      this->offset(c, a, other) > tolerance)
    {
      return Harm::Overlap;
    }
  }
  return Harm::None;
}

// The polygon has no ear: rounding has folded it. The least evil one.
std::size_t Triangulator::chooseAny() const
{
  std::size_t best = kNone;
  std::pair<Harm, double> least = { Harm::Forbidden, 0.0 };
  std::size_t tip = at_;
  for (std::size_t k = 0; k < left_; ++k, tip = next_[tip])
  {
    const std::pair<Harm, double> harm = { this->harmOf(tip), -this->shape(tip) };
    if (harm.first != Harm::Forbidden && harm < least)
    {
      least = harm;
      best = tip;
    }
  }
  return best;
}

// What rounding may have moved a point by.
double Triangulator::tolerance() const
{
  double largest = 0.0;
  for (const std::int32_t point : polygon_)
  {
    const PlanarPoint& p = (*points_)[std::size_t(point)];
    largest = std::max({ largest, std::abs(p.x), std::abs(p.y) });
  }
  return kTolerance * largest;
}

void Triangulator::cut(std::size_t tip)
{
  made_.push_back(this->cornersAt(tip));
  if (!diagonals_.empty())
  {
    diagonals_.insert(std::minmax(polygon_[previous_[tip]], polygon_[next_[tip]]));
  }
  next_[previous_[tip]] = next_[tip];
  previous_[next_[tip]] = previous_[tip];
}

// Whether the polygon goes out and back to a tip, or stays where it is.
bool Triangulator::isSpike(std::size_t tip, double tolerance) const
{
  const auto [a, b, c] = this->cornersAt(tip);
  const PlanarPoint& p = (*points_)[std::size_t(a)];
  const PlanarPoint& q = (*points_)[std::size_t(b)];
  const PlanarPoint& r = (*points_)[std::size_t(c)];
  const double least = std::min(squaredDistance(p, q), squaredDistance(q, r));
  const bool isFlat =
    std::min(std::abs(this->offset(b, a, c)), std::abs(this->offset(b, c, a))) <= tolerance;
  const bool isBack = (p.x - q.x) * (r.x - q.x) + (p.y - q.y) * (r.y - q.y) > 0.0;
  return (least <= tolerance * tolerance || (isFlat && isBack)) && this->mayClip(a, c);
}

// An ear over a spike would cover what is beside it twice.
void Triangulator::clipSpikes()
{
  const double tolerance = this->tolerance();
  std::size_t tip = at_;
  for (std::size_t unseen = left_; unseen > 0 && left_ > 3; --unseen)
  {
    if (this->isSpike(tip, tolerance))
    {
      this->cut(tip);
      --left_;
      unseen = left_ + 1;
    }
    tip = next_[tip];
    at_ = tip;
  }
}

bool Triangulator::clip()
{
  diagonals_.clear();
  for (std::size_t k = 0; hasHoles_ && k < polygon_.size(); ++k)
  {
    diagonals_.insert(std::minmax(polygon_[k], polygon_[(k + 1) % polygon_.size()]));
  }
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
  left_ = count;
  this->clipSpikes();
  for (; left_ >= 3; --left_)
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
    this->cut(tip);
    at_ = next_[next_[tip]]; // a step on, or all ears would meet in one point
  }
  return true;
}

// An edge that two triangles run along the same way.
std::optional<Triangulator::Side> Triangulator::repeatedEdge() const
{
  std::vector<Side> sides;
  for (const Triangle& corner : made_)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      sides.emplace_back(corner[k], corner[(k + 1) % 3]);
      if (corner[k] == corner[(k + 1) % 3])
      {
        return sides.back();
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  const auto found = std::adjacent_find(sides.begin(), sides.end());
  return found != sides.end() ? std::optional<Side>(*found) : std::nullopt;
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
  if (!this->mayJoin(c, d) || (hasHoles_ && diagonals_.count(std::minmax(c, d)) > 0) ||
    this->turn(c, a, d) <= 0 || this->turn(d, b, c) <= 0 ||
    this->worstOf(d, c, a, b) <= this->worstOf(a, b, c, d) * (1.0 + 1e-9))
  {
    return false;
  }
  if (hasHoles_)
  {
    diagonals_.erase(std::minmax(a, b));
    diagonals_.insert(std::minmax(c, d));
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
  hasHoles_ = loops.size() > 1;
  if (!hasHoles_)
  {
    polygon_ = loops.front();
  }
  else if (!this->bridge(loops))
  {
    return false;
  }
  if (!this->clip() || (hasHoles_ && this->repeatedEdge()))
  {
    return false;
  }
  if (this->isFolded())
  {
    this->unfold();
  }
  else if (proper_ && made_.size() > 1)
  {
    polygon_.size() > kSmall ? this->improveLarge() : this->improveSmall();
  }
  triangles.insert(triangles.end(), made_.begin(), made_.end());
  return true;
}

} // namespace hybridtree
