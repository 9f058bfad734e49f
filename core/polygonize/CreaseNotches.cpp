// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreaseNotches.h"

#include "core/mesh/Crossings.h"
#include "core/polygonize/NotchSearch.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 8;
constexpr double kLooking = 0.8;     // of a round's work
constexpr double kNearCorner = 0.05; // cells, that a new point keeps off the old ones
constexpr double kWorthFlip = 0.5;   // of the distance to the surface, that is left at most
constexpr double kLeastTilt =
  0.1; // sum of the cosines of a new triangle to the normals of its corners

using Index = std::int32_t;

/// What may be done at a notch: one or two triangles are replaced.
struct Change
{
  NotchKey site{};
  double height = 0.0;
  bool flips = false;
  std::vector<std::size_t> replaced;
  std::vector<Triangle> made; ///< -1 is the new point
};

class NotchMender
{
public:
  NotchMender(const FieldSource& field, const NotchOptions& options, TriangleMesh& mesh,
    const Progress& progress)
    : cell_(options.cellSize)
    , mesh_(mesh)
    , progress_(progress)
    , search_(field, options, mesh)
    , oldTriangles_(mesh.triangles.size())
    , oldPoints_(mesh.points.size())
  {
  }

  /// \return the number of new points.
  std::size_t run()
  {
    removed_.assign(search_.hasHotPoints() ? oldTriangles_ : 0, false);
    bool changed = search_.hasHotPoints();
    for (int round = 0; round < kRounds && changed; ++round)
    {
      // Places are looked at once, so there are ever fewer.
      const double begin = 1.0 - std::ldexp(1.0, -round);
      const ProgressPart part(progress_, begin, 0.5 * (1.0 + begin));
      search_.update(removed_, ProgressPart(part, 0.0, kLooking));
      changed = this->apply(this->possibleChanges(), ProgressPart(part, kLooking, 1.0));
    }
    return this->finish();
  }

private:
  /// The highest first; triangles come after edges, since these may do for them.
  std::vector<Change> possibleChanges() const
  {
    std::vector<Change> changes;
    for (const TriangleSide& side : search_.sides().all())
    {
      if (const TriangleSide* twin = search_.changeableTwin(side))
      {
        this->addEdge(side, *twin, changes);
      }
    }
    const auto higher = [](const Change& a, const Change& b)
    { return std::make_pair(-a.height, a.site) < std::make_pair(-b.height, b.site); };
    std::sort(changes.begin(), changes.end(), higher);
    const auto edges = static_cast<std::ptrdiff_t>(changes.size());
    for (const std::size_t t : search_.triangles())
    {
      this->addTriangle(t, changes);
    }
    std::sort(changes.begin() + edges, changes.end(), higher);
    return changes;
  }

  void addEdge(
    const TriangleSide& side, const TriangleSide& twin, std::vector<Change>& changes) const
  {
    const NotchKey site = search_.edgeKey(side, twin);
    const NotchPoint& notch = *search_.find(site);
    if (!(notch.height > 0.0) || refused_.count(site) > 0)
    {
      return;
    }
    const auto [p, s, q, r] = site;
    Change change{ site, notch.height, true, { side.triangle, twin.triangle }, {} };
    change.made = { { p, s, r }, { s, q, r } };
    const bool flips = search_.find(NotchSearch::flipped(site))->off < kWorthFlip * notch.off &&
      !search_.mayBeJoined(r, s) && this->looksRight(change, notch);
    if (!flips)
    {
      change.flips = false;
      change.made = { { p, -1, r }, { -1, q, r }, { q, -1, s }, { -1, p, s } };
    }
    if (flips || this->looksRight(change, notch))
    {
      changes.push_back(std::move(change));
    }
  }

  void addTriangle(std::size_t t, std::vector<Change>& changes) const
  {
    const auto [a, b, c] = mesh_.triangles[t];
    const NotchKey site = notchKey(mesh_.triangles[t]);
    const NotchPoint* notch = search_.find(site);
    if (!notch || !(notch->height > 0.0) || refused_.count(site) > 0)
    {
      return;
    }
    Change change{ site, notch->height, false, { t }, {} };
    change.made = { { a, b, -1 }, { b, c, -1 }, { c, a, -1 } };
    if (this->looksRight(change, *notch))
    {
      changes.push_back(std::move(change));
    }
  }

  /// New triangles have some size, and face as the surface does at their corners, or come nearer to
  /// that than those before.
  bool looksRight(const Change& change, const NotchPoint& notch) const
  {
    double before = 3.0;
    for (const std::size_t t : change.replaced)
    {
      before = std::min(before, this->tiltOf(mesh_.triangles[t], notch));
    }
    const double least = std::min(kLeastTilt, before);
    return std::all_of(change.made.begin(), change.made.end(),
      [&](const Triangle& made)
      { return this->tiltOf(made, notch) > least && this->hasSize(made, notch); });
  }

  const Vec3& pointOf(Index v, const NotchPoint& notch) const
  {
    return v < 0 ? notch.point : mesh_.points[v];
  }
  const Vec3& normalOf(Index v, const NotchPoint& notch) const
  {
    return v < 0 ? notch.normal : mesh_.normals[v];
  }

  /// Sum of the cosines of the angles to the normals at the corners.
  double tiltOf(const Triangle& corners, const NotchPoint& notch) const
  {
    const auto [a, b, c] = corners;
    const Vec3& at = this->pointOf(a, notch);
    const Vec3 area = (this->pointOf(b, notch) - at).cross(this->pointOf(c, notch) - at);
    return area.stableNormalized().dot(
      this->normalOf(a, notch) + this->normalOf(b, notch) + this->normalOf(c, notch));
  }

  bool hasSize(const Triangle& corners, const NotchPoint& notch) const
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& from = this->pointOf(corners[k], notch);
      if ((this->pointOf(corners[(k + 1) % 3], notch) - from).norm() < kNearCorner * cell_)
      {
        return false;
      }
    }
    return true;
  }

  // Doing it.

  bool apply(const std::vector<Change>& changes, const Progress& progress)
  {
    const std::size_t points = mesh_.points.size();
    const std::size_t triangles = mesh_.triangles.size();
    std::vector<const Change*> done;
    do
    {
      progress.check();
      progress.report(0.5);
      for (const Change* change : done)
      {
        for (const std::size_t t : change->replaced)
        {
          removed_[t] = false;
        }
      }
      mesh_.points.resize(points);
      mesh_.normals.resize(points);
      mesh_.triangles.resize(triangles);
      removed_.resize(triangles);
      done = this->makeAll(changes);
    } while (this->refuseCrossing(triangles));
    removed_.resize(mesh_.triangles.size(), false);
    search_.heatFrom(triangles);
    return !done.empty();
  }

  /// Those whose triangles are not replaced by one before.
  std::vector<const Change*> makeAll(const std::vector<Change>& changes)
  {
    std::vector<const Change*> done;
    std::set<std::pair<Index, Index>> joined; // by flips
    makerOf_.clear();
    for (const Change& change : changes)
    {
      const bool free = refused_.count(change.site) == 0 &&
        std::none_of(change.replaced.begin(), change.replaced.end(),
          [&](std::size_t t) { return removed_[t]; });
      if (free &&
        (!change.flips || joined.insert(std::minmax(change.site[1], change.site[3])).second))
      {
        this->make(change);
        done.push_back(&change);
      }
    }
    return done;
  }

  void make(const Change& change)
  {
    const auto fresh = static_cast<Index>(mesh_.points.size());
    if (!change.flips)
    {
      mesh_.points.push_back(search_.find(change.site)->point);
      mesh_.normals.push_back(search_.find(change.site)->normal);
    }
    for (const std::size_t t : change.replaced)
    {
      removed_[t] = true;
    }
    for (Triangle made : change.made)
    {
      std::replace(made.begin(), made.end(), Index(-1), fresh);
      mesh_.triangles.push_back(made);
      makerOf_.push_back(change.site);
    }
  }

  bool refuseCrossing(std::size_t firstMade)
  {
    if (firstMade == mesh_.triangles.size())
    {
      return false;
    }
    const auto crossings = newCrossings(mesh_, firstMade, removed_, cell_);
    for (const auto& [s, t] : crossings)
    {
      for (const std::size_t triangle : { s, t })
      {
        if (triangle >= firstMade)
        {
          refused_.insert(makerOf_[triangle - firstMade]);
        }
      }
    }
    return !crossings.empty();
  }

  /// \return the number of new points.
  std::size_t finish()
  {
    if (mesh_.triangles.size() > oldTriangles_)
    {
      dropTriangles(mesh_, removed_);
      mesh_.vertexOrigin.resize(mesh_.vertexOrigin.empty() ? 0 : mesh_.points.size());
    }
    return mesh_.points.size() - oldPoints_;
  }

  const double cell_;
  TriangleMesh& mesh_;
  const Progress& progress_;
  NotchSearch search_;
  const std::size_t oldTriangles_;
  const std::size_t oldPoints_;
  std::vector<bool> removed_; ///< per triangle
  std::set<NotchKey> refused_;
  std::vector<NotchKey> makerOf_; ///< each triangle of this round
};

} // namespace

std::size_t mendNotches(const FieldSource& field, const NotchOptions& options, TriangleMesh& mesh,
  const Progress& progress)
{
  return NotchMender(field, options, mesh, progress).run();
}

} // namespace hybridtree
