// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/FillPolygon.h"

#include "core/geometry/Predicates.h"
#include "core/mesh/BestTriangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using Border = std::vector<std::int32_t>;
using Place = Eigen::Vector2d;

int turn(const Place& a, const Place& b, const Place& c)
{
  return orientation2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y());
}

double twiceArea(const Border& border, const std::vector<Place>& place)
{
  double sum = 0.0;
  const Place& origin = place[border.front()];
  for (std::size_t k = 0; k < border.size(); ++k)
  {
    const Place a = place[border[k]] - origin;
    const Place b = place[border[(k + 1) % border.size()]] - origin;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

bool isInside(const Place& p, const Border& border, const std::vector<Place>& place)
{
  bool inside = false;
  for (std::size_t k = 0; k < border.size(); ++k)
  {
    const Place& a = place[border[k]];
    const Place& b = place[border[(k + 1) % border.size()]];
    if ((a.y() > p.y()) != (b.y() > p.y()))
    {
      inside = inside != ((turn(a, b, p) > 0) == (b.y() > a.y()));
    }
  }
  return inside;
}

/// Open segments that cross, or touch at more than common ends.
bool cross(const Place& a, const Place& b, const Place& c, const Place& d)
{
  if (a == c || a == d || b == c || b == d)
  {
    return false;
  }
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

/// Cosine of the smallest angle, 1 without area; more, by far, for a triangle that turns the wrong
/// way: those come only where nothing else is possible.
double badness(const Place& a, const Place& b, const Place& c)
{
  if (turn(a, b, c) <= 0)
  {
    return 1e3;
  }
  double squared[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
  std::sort(squared, squared + 3);
  const double scale = 2.0 * std::sqrt(squared[1] * squared[2]);
  const double cosine = scale > 0.0 ? (squared[1] + squared[2] - squared[0]) / scale : 1.0;
  const double positive = std::max(cosine, 0.0);
  const double fourth = positive * positive * positive * positive;
  return fourth * fourth;
}

/// One border without holes.
class PolygonFiller
{
public:
  PolygonFiller(
    const Border& border, const std::vector<Place>& place, std::vector<Triangle>& triangles)
    : border_(border), place_(place), triangles_(triangles)
  {
  }

  void fill()
  {
    constexpr std::size_t kMostOptimal = 24;
    if (border_.size() == 3)
    {
      triangles_.push_back({ border_[0], border_[1], border_[2] });
      return;
    }
    border_.size() <= kMostOptimal ? this->fillBest() : this->clipEars();
  }

private:
  const Place& at(std::size_t k) const { return place_[border_[k]]; }

  void fillBest()
  {
    BestTriangulation best;
    best.find(
      border_.size(),
      [this](std::size_t i, std::size_t k, std::size_t j)
      { return badness(this->at(i), this->at(k), this->at(j)); },
      [](std::size_t, std::size_t) { return true; });
    for (const auto& [i, k, j] : best.triangles)
    {
      triangles_.push_back({ border_[i], border_[k], border_[j] });
    }
  }

  /// The best ear first.
  void clipEars()
  {
    std::vector<std::size_t> left(border_.size());
    for (std::size_t k = 0; k < left.size(); ++k)
    {
      left[k] = k;
    }
    std::vector<double> cost(left.size());
    for (std::size_t k = 0; k < left.size(); ++k)
    {
      cost[k] = this->earCost(left, k);
    }
    while (left.size() > 3)
    {
      const auto best =
        static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
      const std::size_t n = left.size();
      triangles_.push_back(
        { border_[left[(best + n - 1) % n]], border_[left[best]], border_[left[(best + 1) % n]] });
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
      cost.erase(cost.begin() + static_cast<std::ptrdiff_t>(best));
      const std::size_t m = left.size();
      for (const std::size_t k : { (best + m - 1) % m, best % m })
      {
        cost[k] = this->earCost(left, k);
      }
    }
    triangles_.push_back({ border_[left[0]], border_[left[1]], border_[left[2]] });
  }

  double earCost(const std::vector<std::size_t>& left, std::size_t k) const
  {
    const std::size_t n = left.size();
    const Place& a = this->at(left[(k + n - 1) % n]);
    const Place& b = this->at(left[k]);
    const Place& c = this->at(left[(k + 1) % n]);
    const double cost = badness(a, b, c);
    if (cost > 1.0)
    {
      return cost;
    }
    for (const std::size_t other : left)
    {
      const Place& p = this->at(other);
      if (p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
        turn(c, a, p) >= 0)
      {
        return 1e2;
      }
    }
    return cost;
  }

  const Border& border_;
  const std::vector<Place>& place_;
  std::vector<Triangle>& triangles_;
};

/// Joins a hole to the border around it by two sides between their nearest points that see each
/// other.
void bridge(Border& outer, const Border& hole, const std::vector<Border>& holes,
  const std::vector<Place>& place)
{
  const auto visible = [&](const Place& a, const Place& b)
  {
    const auto clear = [&](const Border& border)
    {
      for (std::size_t k = 0; k < border.size(); ++k)
      {
        if (cross(a, b, place[border[k]], place[border[(k + 1) % border.size()]]))
        {
          return false;
        }
      }
      return true;
    };
    return clear(outer) && std::all_of(holes.begin(), holes.end(), clear);
  };
  struct Pair
  {
    double squared;
    std::size_t outer;
    std::size_t hole;
  };
  std::vector<Pair> pairs;
  pairs.reserve(outer.size() * hole.size());
  for (std::size_t i = 0; i < outer.size(); ++i)
  {
    for (std::size_t j = 0; j < hole.size(); ++j)
    {
      pairs.push_back({ (place[outer[i]] - place[hole[j]]).squaredNorm(), i, j });
    }
  }
  std::sort(pairs.begin(), pairs.end(),
    [](const Pair& a, const Pair& b)
    { return std::tie(a.squared, a.outer, a.hole) < std::tie(b.squared, b.outer, b.hole); });
  const auto found = std::find_if(pairs.begin(), pairs.end(),
    [&](const Pair& pair) { return visible(place[outer[pair.outer]], place[hole[pair.hole]]); });
  const Pair& pair = found == pairs.end() ? pairs.front() : *found;
  Border joined(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(pair.outer) + 1);
  for (std::size_t k = 0; k <= hole.size(); ++k)
  {
    joined.push_back(hole[(pair.hole + k) % hole.size()]);
  }
  joined.insert(joined.end(), outer.begin() + static_cast<std::ptrdiff_t>(pair.outer), outer.end());
  outer = std::move(joined);
}

} // namespace

std::vector<Triangle> fillPolygon(std::vector<Border> borders, const std::vector<Place>& place)
{
  std::vector<Triangle> triangles;
  std::vector<Border> outer;
  std::vector<Border> holes;
  for (Border& border : borders)
  {
    const bool isHole = borders.size() > 1 && twiceArea(border, place) < 0.0;
    (isHole ? holes : outer).push_back(std::move(border));
  }
  std::vector<std::vector<Border>> holesOf(outer.size());
  for (Border& hole : holes)
  {
    // Rounding may have turned a tiny border round: one that nothing contains is filled by itself.
    std::size_t around = outer.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < outer.size(); ++k)
    {
      const double area = twiceArea(outer[k], place);
      if (area < least && isInside(place[hole.front()], outer[k], place))
      {
        least = area;
        around = k;
      }
    }
    if (around == outer.size())
    {
      PolygonFiller(hole, place, triangles).fill();
      continue;
    }
    holesOf[around].push_back(std::move(hole));
  }
  for (std::size_t k = 0; k < outer.size(); ++k)
  {
    std::vector<Border>& inner = holesOf[k];
    while (!inner.empty())
    {
      const Border hole = std::move(inner.back());
      inner.pop_back();
      std::vector<Border> others = inner;
      others.push_back(hole);
      bridge(outer[k], hole, others, place);
    }
    PolygonFiller(outer[k], place, triangles).fill();
  }
  return triangles;
}

} // namespace hybridtree
