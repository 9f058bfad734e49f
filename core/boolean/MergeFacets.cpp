// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MergeFacets.h"

#include "core/boolean/CompactResult.h"
#include "core/boolean/LocalPart.h"
#include "core/mesh/MeshLinks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 8;
constexpr int kFlipsPerEdge = 10;
// How far points of a facet may be off its plane or line: of the largest coordinate, what rounding
// does; of the facet, what is left where points were moved along it.
constexpr double kRounding = 0x1p-42;
constexpr double kOffPlane = 0x1p-26;
constexpr double kBetter = 1e-9; // by how much a flip has to be: ties stay as they are

// A facet at the cut.
struct Plane
{
  Vec3 normal = Vec3::Zero();
  Box3 box;
  std::array<double, 2> along{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() }; // the normal: where its points are
  double tolerance = 0.0;
  std::int32_t source = -1; // of its first triangle
  bool hasParts = false;    // of several triangles
  bool isFlat = false;
};

class Merger
{
public:
  using Index = MeshLinks::Index;

  Merger(MeshBooleanResult& result, const Facets& facets)
    : result_(result), mesh_(result.mesh), facets_(facets), planeOf_(std::size_t(facets.count), -1)
  {
  }

  void run()
  {
    this->findPlanes();
    if (!this->measurePlanes())
    {
      return;
    }
    this->gatherPart();
    const LocalPart part(corners_);
    Worker worker(*this, part);
    if (worker.run())
    {
      this->writeBack(part, worker);
    }
  }

private:
  // Works on points numbered anew.
  class Worker
  {
  public:
    Worker(Merger& owner, const LocalPart& part)
      : owner_(owner), part_(part), links_(part.triangles, part.pointOf.size())
    {
    }

    bool run();
    const MeshLinks& links() const { return links_; }

    /// Pairs of points of the part: the first has become the second.
    std::vector<std::array<Index, 2>> merged;

  private:
    // A point that may go, as its triangles tell.
    struct Around
    {
      std::array<std::int32_t, 2> facet{ -1, -1 }; // one, or two with a straight border
      std::array<Index, 2> along{ MeshLinks::kNone, MeshLinks::kNone }; // edges of the border
      std::size_t count = 0;
    };

    const Vec3& at(Index point) const
    {
      return owner_.mesh_.points[std::size_t(part_.pointOf[std::size_t(point)])];
    }
    std::int32_t facetOf(Index h) const { return owner_.plane_[std::size_t(h / 3)]; }
    const Plane& planeOf(Index h) const { return owner_.planes_[std::size_t(this->facetOf(h))]; }
    bool mayChange(std::int32_t facet) const
    {
      return facet >= 0 && owner_.planes_[std::size_t(facet)].isFlat;
    }
    bool isWithin(Index h) const
    {
      const Index g = links_.twin(h);
      return g != MeshLinks::kNone && this->facetOf(h) == this->facetOf(g) &&
        this->mayChange(this->facetOf(h));
    }

    double heightOf(const Plane& plane, Index a, Index b, Index c) const;
    double cotangentAt(Index apex, Index a, Index b) const;
    bool mayFlip(Index h) const;
    bool isDelaunay(Index h) const;
    bool lookAround(Index point, Around& around) const;
    bool isStraight(Index point, const Around& around) const;
    bool thinOut(Index point, std::size_t left);
    Index spokeToFlip(Index point) const;
    bool collapseAlong(Index h);
    bool remove(Index point);
    void improve();

    Merger& owner_;
    const LocalPart& part_;
    MeshLinks links_;
    std::vector<char> changed_; // per plane
  };

  bool isAtCut(const Triangle& corner) const
  {
    return std::any_of(corner.begin(), corner.end(),
      [&](std::int32_t point) { return std::size_t(point) >= result_.firstCut; });
  }

  // Into planes_, -1 for triangles of a facet that is not at the cut.
  std::int32_t planeAt(std::size_t t) const
  {
    return facets_.of[t] < 0 ? -1 : planeOf_[std::size_t(facets_.of[t])];
  }

  void findPlanes()
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) < 0 && facets_.of[t] >= 0 && this->isAtCut(mesh_.triangles[t]))
      {
        planeOf_[std::size_t(facets_.of[t])] = std::int32_t(planes_.size());
        planes_.emplace_back();
      }
    }
  }

  template <class Visit>
  void forEachAtCut(Visit&& visit)
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) >= 0)
      {
        visit(t, planes_[std::size_t(this->planeAt(t))]);
      }
    }
  }

  // Whether there is a facet of parts.
  bool measurePlanes()
  {
    bool any = false;
    double largest = 0.0;
    for (const Vec3& p : mesh_.points)
    {
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    this->forEachAtCut(
      [&](std::size_t t, Plane& plane)
      {
        const std::int32_t source = result_.sourceTriangle[t];
        plane.hasParts = plane.hasParts || (plane.source >= 0 && plane.source != source);
        plane.source = source;
        plane.normal += areaNormal(mesh_, t);
        any = any || plane.hasParts;
      });
    if (!any)
    {
      return false;
    }
    for (Plane& plane : planes_)
    {
      plane.normal.stableNormalize();
    }
    this->forEachAtCut(
      [&](std::size_t t, Plane& plane)
      {
        for (const std::int32_t point : mesh_.triangles[t])
        {
          const Vec3& p = mesh_.points[std::size_t(point)];
          plane.along[0] = std::min(plane.along[0], plane.normal.dot(p));
          plane.along[1] = std::max(plane.along[1], plane.normal.dot(p));
          plane.box.extend(p);
        }
      });
    for (Plane& plane : planes_)
    {
      plane.tolerance = kRounding * largest + kOffPlane * plane.box.sizes().norm();
      plane.isFlat = plane.along[1] - plane.along[0] <= plane.tolerance;
    }
    return true;
  }

  // The facets that may change, and all triangles around their points.
  void gatherPart()
  {
    std::vector<char> near(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (this->planeAt(t) >= 0 && planes_[std::size_t(this->planeAt(t))].isFlat)
      {
        for (const std::int32_t point : mesh_.triangles[t])
        {
          near[std::size_t(point)] = 1;
        }
      }
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& corner = mesh_.triangles[t];
      if (std::any_of(corner.begin(), corner.end(),
            [&](std::int32_t point) { return near[std::size_t(point)] != 0; }))
      {
        triangles_.push_back(std::int32_t(t));
        corners_.push_back(corner);
        plane_.push_back(this->planeAt(t));
      }
    }
  }

  void writeBack(const LocalPart& part, const Worker& worker)
  {
    part.write(worker.links(), corners_);
    for (std::size_t k = 0; k < triangles_.size(); ++k)
    {
      mesh_.triangles[std::size_t(triangles_[k])] = corners_[k];
    }
    std::vector<std::int32_t> becomes(mesh_.points.size());
    std::iota(becomes.begin(), becomes.end(), 0);
    for (const std::array<Index, 2>& merge : worker.merged)
    {
      becomes[std::size_t(part.pointOf[std::size_t(merge[0])])] =
        part.pointOf[std::size_t(merge[1])];
    }
    compactResult(result_, becomes);
  }

  MeshBooleanResult& result_;
  TriangleMesh& mesh_;
  const Facets& facets_;
  std::vector<std::int32_t> planeOf_; // per facet: into planes_, -1 for one away from the cut
  std::vector<Plane> planes_;
  std::vector<std::int32_t> triangles_; // of the part
  std::vector<Triangle> corners_;       // theirs
  std::vector<std::int32_t> plane_;     // theirs
};

// Over its longest side; below 0 where it faces against its plane.
double Merger::Worker::heightOf(const Plane& plane, Index a, Index b, Index c) const
{
  const Vec3 ab = this->at(b) - this->at(a);
  const Vec3 ac = this->at(c) - this->at(a);
  const double longest = std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() });
  return longest > 0.0 ? ab.cross(ac).dot(plane.normal) / std::sqrt(longest) : 0.0;
}

double Merger::Worker::cotangentAt(Index apex, Index a, Index b) const
{
  const Vec3 toA = this->at(a) - this->at(apex);
  const Vec3 toB = this->at(b) - this->at(apex);
  return toA.dot(toB) / toA.cross(toB).norm();
}

// Whether the diagonal may be the other one: both triangles have a height then, or more than
// before.
bool Merger::Worker::mayFlip(Index h) const
{
  if (!this->isWithin(h) || !links_.canFlip(h))
  {
    return false;
  }
  const Plane& plane = this->planeOf(h);
  const Index a = links_.from(h);
  const Index b = links_.to(h);
  const Index c = links_.opposite(h);
  const Index d = links_.opposite(links_.twin(h));
  const double least = std::min(this->heightOf(plane, d, b, c), this->heightOf(plane, c, a, d));
  return least > plane.tolerance ||
    least > std::min(this->heightOf(plane, a, b, c), this->heightOf(plane, b, a, d));
}

bool Merger::Worker::isDelaunay(Index h) const
{
  const Index a = links_.from(h);
  const Index b = links_.to(h);
  const double sum = this->cotangentAt(links_.opposite(h), a, b) +
    this->cotangentAt(links_.opposite(links_.twin(h)), a, b);
  return !(sum < -kBetter); // NaN too: nothing to be had from what is flat
}

// Whether all around a point is of one facet, or of two that may change.
bool Merger::Worker::lookAround(Index point, Around& around) const
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

bool Merger::Worker::isStraight(Index point, const Around& around) const
{
  const Vec3& p = this->at(point);
  const Vec3 toA = this->at(links_.to(around.along[0])) - p;
  const Vec3 toB = this->at(links_.to(around.along[1])) - p;
  const double length = (toB - toA).norm();
  const double tolerance = std::min(owner_.planes_[std::size_t(around.facet[0])].tolerance,
    owner_.planes_[std::size_t(around.facet[1])].tolerance);
  return toA.dot(toB) < 0.0 && toA.cross(toB).norm() <= tolerance * length;
}

// An edge from the point that may be flipped away; the one that leaves the better triangles.
MeshLinks::Index Merger::Worker::spokeToFlip(Index point) const
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
      const Plane& plane = this->planeOf(h);
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
bool Merger::Worker::thinOut(Index point, std::size_t left)
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
bool Merger::Worker::collapseAlong(Index h)
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
      const Plane& plane = this->planeOf(leaving);
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

bool Merger::Worker::remove(Index point)
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
void Merger::Worker::improve()
{
  std::vector<Index> stack;
  for (std::size_t t = links_.triangleCount(); t-- > 0;)
  {
    const std::int32_t facet = owner_.plane_[t];
    if (!links_.isRemoved(t) && this->mayChange(facet) &&
      (changed_[std::size_t(facet)] != 0 || owner_.planes_[std::size_t(facet)].hasParts))
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

bool Merger::Worker::run()
{
  changed_.assign(owner_.planes_.size(), 0);
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

} // namespace

Facets facetsOf(const MeshBooleanResult& result, const std::array<Facets, 2>& operands,
  const std::array<std::size_t, 2>& triangles)
{
  std::array<std::int32_t, 2> count{};
  for (std::size_t k = 0; k < 2; ++k)
  {
    count[k] = operands[k].of.empty() ? std::int32_t(triangles[k]) : operands[k].count;
  }
  Facets facets;
  facets.count = count[0] + count[1];
  facets.of.reserve(result.mesh.triangles.size());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    const std::size_t operand = std::size_t(result.sourceOperand[t]);
    const std::int32_t source = result.sourceTriangle[t];
    const std::int32_t facet = source < 0 ? -1 : operands[operand].at(source);
    facets.of.push_back(facet < 0 ? -1 : facet + (operand == 0 ? 0 : count[0]));
  }
  return facets;
}

void mergeFacets(MeshBooleanResult& result, const Facets& facets)
{
  Merger(result, facets).run();
}

} // namespace hybridtree
