// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/RefinePolygon.h"

#include "core/stitch/TriangleShape.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace hybridtree
{
namespace
{

using Index = std::int32_t;
using Vec2 = Eigen::Vector2d;

constexpr std::size_t kMostTriangles = 1500;
constexpr double kSliver = 0.9848;    // cosine of 10 degrees
constexpr double kGoodShape = 0.9397; // cosine of 20 degrees, which is aimed at
constexpr double kSteps = 2.3;        // lengths of a side to where it is seen under 25 degrees
constexpr double kLeastHeight = 0.2;  // of a point over a side of the border, to the nearer end
constexpr double kRounding = 1e-9;    // of squared lengths

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

class Refiner
{
public:
  Refiner(const std::vector<Triangle>& triangles, const std::vector<Vec2>& place)
    : triangles_(triangles), place_(place), mostPoints_(3 * place.size() + 20)
  {
    for (Index t = 0; t < Index(triangles_.size()); ++t)
    {
      this->link(t);
    }
    for (const auto& [side, t] : owner_)
    {
      if (owner_.count({ side.second, side.first }) == 0)
      {
        border_.push_back(side);
      }
    }
  }

  void run()
  {
    for (const auto& [side, t] : std::map<Side, Index>(owner_))
    {
      waiting_.push_back(side);
    }
    this->flipAll();
    while (place_.size() < mostPoints_)
    {
      const Index worst = this->worstTriangle();
      if (worst < 0)
      {
        return;
      }
      if (!this->splitBeside(worst))
      {
        hopeless_.insert(this->sorted(worst));
      }
    }
  }

  std::size_t slivers() const
  {
    return static_cast<std::size_t>(std::count_if(triangles_.begin(), triangles_.end(),
      [&](const Triangle& c) { return this->shape(c) > kSliver; }));
  }

  void give(std::vector<Triangle>& triangles, std::vector<Vec2>& place)
  {
    triangles = std::move(triangles_);
    place = std::move(place_);
  }

private:
  using Side = std::pair<Index, Index>;

  double area(Index a, Index b, Index c) const
  {
    return cross(place_[b] - place_[a], place_[c] - place_[a]);
  }

  double shape(const Triangle& c) const
  {
    const auto at = [&](Index v) { return Vec3(place_[v].x(), place_[v].y(), 0.0); };
    return shapeOf(at(c[0]), at(c[1]), at(c[2]));
  }

  Triangle sorted(Index t) const
  {
    Triangle c = triangles_[t];
    std::sort(c.begin(), c.end());
    return c;
  }

  void link(Index t)
  {
    const Triangle& c = triangles_[t];
    for (int k = 0; k < 3; ++k)
    {
      owner_[{ c[k], c[(k + 1) % 3] }] = t;
    }
  }

  Index opposite(const Side& side, Index t) const
  {
    const Triangle& c = triangles_[t];
    return c[0] + c[1] + c[2] - side.first - side.second;
  }

  /// Flips edges until no circle around a triangle has a point beside it inside.
  void flipAll()
  {
    std::size_t left = 100 * triangles_.size(); // rounding could make it go on forever
    while (!waiting_.empty() && left-- > 0)
    {
      const Side side = waiting_.back();
      waiting_.pop_back();
      const auto own = owner_.find(side);
      const auto twin = owner_.find({ side.second, side.first });
      if (own != owner_.end() && twin != owner_.end())
      {
        this->flip(side, own->second, twin->second);
      }
    }
    waiting_.clear();
  }

  void flip(const Side& side, Index t, Index s)
  {
    const auto [a, b] = side;
    const Index c = this->opposite(side, t);
    const Index d = this->opposite(side, s);
    // The angles across the edge: flipped where they sum to more than a half turn.
    const Vec2 ca = place_[a] - place_[c], cb = place_[b] - place_[c];
    const Vec2 da = place_[a] - place_[d], db = place_[b] - place_[d];
    const double sine = cross(ca, cb) * da.dot(db) + ca.dot(cb) * cross(db, da);
    const double scale =
      (ca.squaredNorm() + cb.squaredNorm()) * (da.squaredNorm() + db.squaredNorm());
    const double least = kRounding * (place_[c] - place_[d]).squaredNorm();
    if (!(sine < -kRounding * scale) || !(this->area(a, d, c) > least) ||
      !(this->area(d, b, c) > least))
    {
      return;
    }
    owner_.erase({ a, b });
    owner_.erase({ b, a });
    triangles_[t] = { a, d, c };
    triangles_[s] = { d, b, c };
    this->link(t);
    this->link(s);
    waiting_.insert(waiting_.end(), { { a, d }, { d, b }, { b, c }, { c, a } });
  }

  Index worstTriangle() const
  {
    double worst = kGoodShape;
    Index found = -1;
    for (Index t = 0; t < Index(triangles_.size()); ++t)
    {
      const double shape = this->shape(triangles_[t]);
      if (shape > worst && hopeless_.count(this->sorted(t)) == 0)
      {
        worst = shape;
        found = t;
      }
    }
    return found;
  }

  /// A point over the shortest side of a triangle, from where it is seen under a good angle, or in
  /// the centre of the circle around the triangle if that is nearer; if that is a good place.
  bool splitBeside(Index bad)
  {
    Triangle c = triangles_[bad];
    const auto length = [&](int k) { return (place_[c[(k + 1) % 3]] - place_[c[k]]).norm(); };
    const int shortest =
      length(0) <= length(1) ? (length(0) <= length(2) ? 0 : 2) : (length(1) <= length(2) ? 1 : 2);
    std::rotate(c.begin(), c.begin() + shortest, c.end());
    const Vec2 side = place_[c[1]] - place_[c[0]];
    const Vec2 other = place_[c[2]] - place_[c[0]];
    const double toCentre = (other.squaredNorm() - other.dot(side)) / (2.0 * cross(side, other));
    const Vec2 at =
      place_[c[0]] + 0.5 * side + std::min(toCentre, kSteps) * Vec2(-side.y(), side.x());
    if (!at.allFinite() || !this->isClearOfBorder(at))
    {
      return false;
    }
    const auto around = std::find_if(triangles_.begin(), triangles_.end(),
      [&](const Triangle& t) { return this->isInside(at, t); });
    if (around == triangles_.end())
    {
      return false;
    }
    this->split(static_cast<Index>(around - triangles_.begin()), at);
    return true;
  }

  bool isInside(const Vec2& p, const Triangle& c) const
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec2& from = place_[c[k]];
      const Vec2 way = place_[c[(k + 1) % 3]] - from;
      if (!(cross(way, p - from) > 1e-6 * way.squaredNorm()))
      {
        return false;
      }
    }
    return true;
  }

  bool isClearOfBorder(const Vec2& p) const
  {
    return std::all_of(border_.begin(), border_.end(),
      [&](const Side& side)
      {
        const Vec2 from = p - place_[side.first];
        const Vec2 way = place_[side.second] - place_[side.first];
        const double share = from.dot(way) / way.squaredNorm();
        if (share <= 0.0 || share >= 1.0)
        {
          return true;
        }
        const double nearer = std::min(from.norm(), (p - place_[side.second]).norm());
        return std::abs(cross(way, from)) > kLeastHeight * nearer * way.norm();
      });
  }

  void split(Index t, const Vec2& at)
  {
    const auto made = static_cast<Index>(place_.size());
    place_.push_back(at);
    const auto [a, b, c] = triangles_[t];
    const auto second = static_cast<Index>(triangles_.size());
    triangles_[t] = { a, b, made };
    triangles_.push_back({ b, c, made });
    triangles_.push_back({ c, a, made });
    this->link(t);
    this->link(second);
    this->link(second + 1);
    waiting_.insert(waiting_.end(), { { a, b }, { b, c }, { c, a } });
    this->flipAll();
  }

  std::vector<Triangle> triangles_;
  std::vector<Vec2> place_;
  const std::size_t mostPoints_;
  std::map<Side, Index> owner_; ///< of a side, counter-clockwise
  std::vector<Side> border_;
  std::vector<Side> waiting_;
  std::set<Triangle> hopeless_;
};

bool isTurned(const Triangle& c, const std::vector<Vec2>& place)
{
  const Vec2 b = place[c[1]] - place[c[0]];
  const Vec2 d = place[c[2]] - place[c[0]];
  return !(cross(b, d) > -1e-9 * (b.squaredNorm() + d.squaredNorm())); // flat ones are flipped
}

} // namespace

void refinePolygon(std::vector<Triangle>& triangles, std::vector<Vec2>& place)
{
  if (triangles.size() > kMostTriangles ||
    std::any_of(
      triangles.begin(), triangles.end(), [&](const Triangle& c) { return isTurned(c, place); }))
  {
    return;
  }
  Refiner refiner(triangles, place);
  const std::size_t before = refiner.slivers();
  if (before == 0)
  {
    return;
  }
  refiner.run();
  if (refiner.slivers() < before)
  {
    refiner.give(triangles, place);
  }
}

} // namespace hybridtree
