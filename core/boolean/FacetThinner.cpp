// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/FacetThinner.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 8;
constexpr int kFlipsPerEdge = 10;
constexpr double kBetter = 1e-9; // by how much a flip has to be: ties stay as they are

} // namespace

// Over its longest side; below 0 where it faces against its plane.
double FacetThinner::heightOf(const FacetPlane& plane, Index a, Index b, Index c) const
{
  const Vec3 ab = this->at(b) - this->at(a);
  const Vec3 ac = this->at(c) - this->at(a);
  const double longest = std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() });
  return longest > 0.0 ? ab.cross(ac).dot(plane.normal) / std::sqrt(longest) : 0.0;
}

double FacetThinner::cotangentAt(Index apex, Index a, Index b) const
{
  const Vec3 toA = this->at(a) - this->at(apex);
  const Vec3 toB = this->at(b) - this->at(apex);
  return toA.dot(toB) / toA.cross(toB).norm();
}

// Whether the diagonal may be the other one: both triangles have a height then, or more than
// before.
bool FacetThinner::mayFlip(Index h) const
{
  if (!this->isWithin(h) || !links_.canFlip(h))
  {
    return false;
  }
  const FacetPlane& plane = this->planeOf(h);
  const Index a = links_.from(h);
  const Index b = links_.to(h);
  const Index c = links_.opposite(h);
  const Index d = links_.opposite(links_.twin(h));
  const double least = std::min(this->heightOf(plane, d, b, c), this->heightOf(plane, c, a, d));
  return least > plane.tolerance ||
    least > std::min(this->heightOf(plane, a, b, c), this->heightOf(plane, b, a, d));
}

bool FacetThinner::isDelaunay(Index h) const
{
  const Index a = links_.from(h);
  const Index b = links_.to(h);
  const double sum = this->cotangentAt(links_.opposite(h), a, b) +
    this->cotangentAt(links_.opposite(links_.twin(h)), a, b);
  return !(sum < -kBetter); // NaN too: nothing to be had from what is flat
}

// Whether all around a point is of one facet, or of two that may change.
bool FacetThinner::lookAround(Index point, Around& around) const
{
  if (links_.isLocked(point))
  {
    return false;
  }
  bool may = true;
  std::size_t changes = 0;
  links_.forEachLeaving(point,
    [&](Index h)
    {
      ++around.count;
      const std::int32_t here = this->facetOf(h);
      may = may && this->mayChange(here);
      if (here != this->facetOf(links_.twin(h)))
      {
        if (changes < 2)
        {
          around.facet[changes] = here;
          around.along[changes] = h;
        }
        ++changes;
      }
      else if (changes == 0)
      {
        around.facet[0] = here;
      }
    });
  return may && (changes == 0 || (changes == 2 && this->isStraight(point, around)));
}

bool FacetThinner::isStraight(Index point, const Around& around) const
{
  const Vec3& p = this->at(point);
  const Vec3 toA = this->at(links_.to(around.along[0])) - p;
  const Vec3 toB = this->at(links_.to(around.along[1])) - p;
  const double length = (toB - toA).norm();
  const double tolerance = std::min(planes_[std::size_t(around.facet[0])].tolerance,
    planes_[std::size_t(around.facet[1])].tolerance);
  return toA.dot(toB) < 0.0 && toA.cross(toB).norm() <= tolerance * length;
}

// An edge from the point that may be flipped away; the one that leaves the better triangles.
MeshLinks::Index FacetThinner::spokeToFlip(Index point) const
{
  Index best = MeshLinks::kNone;
  double most = 0.0;
  links_.forEachLeaving(point,
    [&](Index h)
    {
      if (!this->mayFlip(h))
      {
        return;
      }
      const FacetPlane& plane = this->planeOf(h);
      const Index g = links_.twin(h);
      const double outer =
        this->heightOf(plane, links_.opposite(g), links_.to(h), links_.opposite(h));
      const double inner = this->heightOf(plane, links_.opposite(h), point, links_.opposite(g));
      if (std::min(outer, inner) > 0.0 && outer > most)
      {
        most = outer;
        best = h;
      }
    });
  return best;
}

// Flips edges of a point until so many are left.
bool FacetThinner::thinOut(Index point, std::size_t left)
{
  std::size_t count = 0;
  links_.forEachLeaving(point, [&](Index) { ++count; });
  for (; count > left; --count)
  {
    const Index h = this->spokeToFlip(point);
    if (h == MeshLinks::kNone)
    {
      return false;
    }
    changed_[std::size_t(this->facetOf(h))] = 1;
    links_.flip(h);
  }
  return true;
}

// Merges the start into the end where no triangle turns over or loses its height.
bool FacetThinner::collapseAlong(Index h)
{
  const Index from = links_.from(h);
  const Index to = links_.to(h);
  if (!links_.canCollapse(h))
  {
    return false;
  }
  bool turns = false;
  links_.forEachLeaving(from,
    [&](Index leaving)
    {
      const Index p = links_.to(leaving);
      const Index q = links_.opposite(leaving);
      const FacetPlane& plane = this->planeOf(leaving);
      if (p != to && q != to && !turns)
      {
        const double height = this->heightOf(plane, to, p, q);
        turns = !(height > plane.tolerance || height > this->heightOf(plane, from, p, q));
      }
    });
  if (turns)
  {
    return false;
  }
  links_.forEachLeaving(
    from, [&](Index leaving) { changed_[std::size_t(this->facetOf(leaving))] = 1; });
  links_.collapse(h);
  merged.push_back({ from, to });
  return true;
}

bool FacetThinner::remove(Index point)
{
  Around around;
  if (!this->lookAround(point, around))
  {
    return false;
  }
  if (around.along[0] != MeshLinks::kNone)
  {
    const std::array<Index, 2> ends = { links_.to(around.along[0]), links_.to(around.along[1]) };
    this->thinOut(point, 4);
    for (const Index end : ends)
    {
      Index along = MeshLinks::kNone;
      links_.forEachLeaving(point, [&](Index h) { along = links_.to(h) == end ? h : along; });
      if (along != MeshLinks::kNone && this->collapseAlong(along))
      {
        return true;
      }
    }
    return false;
  }
  this->thinOut(point, 3);
  std::vector<Index> leaving;
  links_.forEachLeaving(point, [&](Index h) { leaving.push_back(h); });
  return std::any_of(
    leaving.begin(), leaving.end(), [&](Index h) { return this->collapseAlong(h); });
}

// Lawson's flips, in the facets that have changed or are parts of several triangles.
void FacetThinner::improve()
{
  std::vector<Index> stack;
  for (std::size_t t = links_.triangleCount(); t-- > 0;)
  {
    const std::int32_t facet = planeOf_[t];
    if (!links_.isRemoved(t) && this->mayChange(facet) &&
      (changed_[std::size_t(facet)] != 0 || planes_[std::size_t(facet)].hasParts))
    {
      stack.insert(stack.end(), { 3 * Index(t) + 2, 3 * Index(t) + 1, 3 * Index(t) });
    }
  }
  for (std::size_t budget = kFlipsPerEdge * stack.size(); !stack.empty() && budget > 0; --budget)
  {
    const Index h = stack.back();
    stack.pop_back();
    if (!this->mayFlip(h) || this->isDelaunay(h))
    {
      continue;
    }
    const Index g = links_.twin(h);
    changed_[std::size_t(this->facetOf(h))] = 1;
    links_.flip(h);
    for (const Index t : { h / 3, g / 3 })
    {
      stack.insert(stack.end(), { 3 * t, 3 * t + 1, 3 * t + 2 });
    }
  }
}

bool FacetThinner::run()
{
  changed_.assign(planes_.size(), 0);
  bool removed = true;
  for (int round = 0; round < kRounds && removed; ++round)
  {
    removed = false;
    for (std::size_t point = 0; point < part_.pointOf.size(); ++point)
    {
      removed = this->remove(Index(point)) || removed;
    }
  }
  this->improve();
  return std::count(changed_.begin(), changed_.end(), char(1)) > 0;
}

} // namespace hybridtree
