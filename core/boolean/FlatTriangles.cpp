// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/FlatTriangles.h"

#include "core/boolean/LocalPart.h"
#include "core/mesh/MeshLinks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 40;

double heightOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double longest =
    std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() });
  return longest > 0.0 ? (b - a).cross(c - a).norm() / std::sqrt(longest) : 0.0;
}

} // namespace

bool isFlat(const Vec3& a, const Vec3& b, const Vec3& c, double tolerance)
{
  return !(heightOf(a, b, c) > tolerance);
}

// Works on points numbered anew.
class FlatTriangles::Worker
{
public:
  using Index = MeshLinks::Index;

  Worker(FlatTriangles& owner, const LocalPart& part)
    : owner_(owner)
    , part_(part)
    , pointOf_(part.pointOf)
    , links_(part.triangles, part.pointOf.size())
  {
  }

  void run()
  {
    bool changed = true;
    for (int round = 0; round < kRounds && changed; ++round)
    {
      changed = false;
      for (std::size_t t = 0; t < links_.triangleCount(); ++t)
      {
        changed = (this->isFlatNow(t) && (this->collapse(t) || this->flip(t))) ||
          (owner_.unfolds_ && this->unfold(t)) || changed;
      }
    }
    part_.write(links_, owner_.triangles_);
  }

private:
  const Vec3& at(Index point) const
  {
    return owner_.points_[std::size_t(pointOf_[std::size_t(point)])];
  }

  double height(Index a, Index b, Index c) const
  {
    return heightOf(this->at(a), this->at(b), this->at(c));
  }

  bool isFlatNow(std::size_t t) const
  {
    const Triangle& c = links_.triangle(t);
    return !links_.isRemoved(t) && !(this->height(c[0], c[1], c[2]) > owner_.tolerance_);
  }

  double length(Index h) const
  {
    return (this->at(links_.to(h)) - this->at(links_.from(h))).norm();
  }

  bool collapse(std::size_t t)
  {
    for (Index k = 0; k < 3; ++k)
    {
      Index h = 3 * Index(t) + k;
      if (!(this->length(h) <= owner_.tolerance_) || !links_.canCollapse(h))
      {
        continue;
      }
      const auto order = [&](Index point)
      {
        const std::int32_t global = pointOf_[std::size_t(point)];
        return std::make_pair(owner_.rank_(global), global);
      };
      if (order(links_.from(h)) < order(links_.to(h)))
      {
        h = links_.twin(h);
      }
      owner_.merged_.push_back(
        { pointOf_[std::size_t(links_.from(h))], pointOf_[std::size_t(links_.to(h))] });
      links_.collapse(h);
      return true;
    }
    return false;
  }

  // Over the longest side into the neighbour, which the flat triangle's apex then divides.
  bool flip(std::size_t t)
  {
    Index h = 3 * Index(t);
    for (Index k = 1; k < 3; ++k)
    {
      h = this->length(3 * Index(t) + k) > this->length(h) ? 3 * Index(t) + k : h;
    }
    if (links_.twin(h) == MeshLinks::kNone || !links_.canFlip(h))
    {
      return false;
    }
    const auto [g, a, b, c, d] = this->aroundEdge(h);
    const double neighbour = this->height(b, a, d);
    const Vec3 normal = (this->at(a) - this->at(b)).cross(this->at(d) - this->at(b));
    const auto isTurned = [&](Index p, Index q, Index r)
    { return (this->at(q) - this->at(p)).cross(this->at(r) - this->at(p)).dot(normal) < 0.0; };
    if (neighbour > owner_.tolerance_ && (isTurned(d, b, c) || isTurned(c, a, d)))
    {
      return false;
    }
    const double worst = std::min(this->height(d, b, c), this->height(c, a, d));
    if (!(worst > owner_.tolerance_) && !((this->at(c) - this->at(d)).norm() < this->length(h)))
    {
      return false;
    }
    owner_.place_[std::size_t(h / 3)] = owner_.place_[std::size_t(g / 3)];
    links_.flip(h);
    return true;
  }

  // Its twin, where it starts and ends, and the corners opposite of it on either side.
  std::array<Index, 5> aroundEdge(Index h) const
  {
    const Index g = links_.twin(h);
    return { g, links_.from(h), links_.to(h), links_.opposite(h), links_.opposite(g) };
  }

  Vec3 normal(Index a, Index b, Index c) const
  {
    return (this->at(b) - this->at(a)).cross(this->at(c) - this->at(a));
  }

  bool unfold(std::size_t t)
  {
    for (Index h = 3 * Index(t); h < 3 * Index(t) + 3 && !links_.isRemoved(t); ++h)
    {
      if (links_.twin(h) != MeshLinks::kNone && links_.canFlip(h) && this->isFolded(h))
      {
        links_.flip(h);
        return true;
      }
    }
    return false;
  }

  // Whether the surface turns back on itself at an edge, and a flip makes it less: what then faces
  // as the larger triangle did is of its face.
  bool isFolded(Index h)
  {
    const auto [g, a, b, c, d] = this->aroundEdge(h);
    const Vec3 here = this->normal(a, b, c);
    const Vec3 there = this->normal(b, a, d);
    if (!(here.dot(there) < 0.0))
    {
      return false;
    }
    const double areaHere = here.norm();
    const double areaThere = there.norm();
    const double height = areaHere > areaThere
      ? std::abs(here.dot(this->at(d) - this->at(a))) / areaHere
      : std::abs(there.dot(this->at(c) - this->at(a))) / areaThere;
    const Vec3 first = this->normal(d, b, c);
    const Vec3 second = this->normal(c, a, d);
    if (!(height <= owner_.tolerance_) ||
      !(areaHere + areaThere - first.norm() - second.norm() >
        2.0 * owner_.tolerance_ * this->length(h)))
    {
      return false;
    }
    std::int32_t& placeHere = owner_.place_[std::size_t(h / 3)];
    std::int32_t& placeThere = owner_.place_[std::size_t(g / 3)];
    const std::int32_t larger = areaHere > areaThere ? placeHere : placeThere;
    const std::int32_t smaller = areaHere > areaThere ? placeThere : placeHere;
    const Vec3& up = areaHere > areaThere ? here : there;
    placeHere = first.dot(up) < 0.0 ? smaller : larger;
    placeThere = second.dot(up) < 0.0 ? smaller : larger;
    return true;
  }

  FlatTriangles& owner_;
  const LocalPart& part_;
  const std::vector<std::int32_t>& pointOf_;
  MeshLinks links_;
};

FlatTriangles::FlatTriangles(const std::vector<Vec3>& points, std::vector<Triangle> triangles,
  std::function<int(std::int32_t)> rank, double tolerance, bool unfolds)
  : points_(points)
  , triangles_(std::move(triangles))
  , rank_(std::move(rank))
  , tolerance_(tolerance)
  , unfolds_(unfolds)
  , place_(triangles_.size())
{
  std::iota(place_.begin(), place_.end(), 0);
}

void FlatTriangles::remove()
{
  const LocalPart part(triangles_);
  Worker(*this, part).run();
}

} // namespace hybridtree
