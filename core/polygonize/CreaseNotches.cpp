// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreaseNotches.h"

#include "core/mesh/Crossings.h"
#include "core/polygonize/NotchPoints.h"
#include "core/polygonize/TriangleSides.h"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 8;
constexpr double kNearCorner = 0.05; // cells, that a new point keeps off the old ones
constexpr double kWorthFlip = 0.5;   // of the distance to the surface, that is left at most
constexpr double kLeastTilt =
  0.1; // sum of the cosines of a new triangle to the normals of its corners

using Index = std::int32_t;

/// The points of a site, as in NotchSite; the last one of a triangle is -1. The first one is the
/// lowest, so that each site has one key.
using SiteKey = std::array<Index, 4>;

struct SiteHash
{
  std::size_t operator()(const SiteKey& key) const
  {
    std::uint64_t hash = 0;
    for (const Index v : key)
    {
      hash = (hash ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

SiteKey triangleKey(const Triangle& corners)
{
  SiteKey key{ corners[0], corners[1], corners[2], -1 };
  std::rotate(key.begin(), std::min_element(key.begin(), key.begin() + 3), key.begin() + 3);
  return key;
}

/// What may be done at a notch: one or two triangles are replaced.
struct Change
{
  SiteKey site{};
  double height = 0.0;
  bool flips = false;
  std::vector<std::size_t> replaced;
  std::vector<Triangle> made; ///< -1 is the new point
};

class NotchMender
{
public:
  NotchMender(const FieldSource& field, double cellSize, double leastCosine, std::size_t first,
    TriangleMesh& mesh, const Progress& progress)
    : field_(field)
    , cell_(cellSize)
    , leastCosine_(leastCosine)
    , first_(first)
    , mesh_(mesh)
    , progress_(progress)
    , oldTriangles_(mesh.triangles.size())
    , oldPoints_(mesh.points.size())
  {
  }

  std::size_t run()
  {
    if (!this->findHotPoints())
    {
      return 0;
    }
    removed_.assign(oldTriangles_, false);
    bool changed = true;
    for (int round = 0; round < kRounds && changed; ++round)
    {
      this->findRegion();
      this->lookAtSites();
      changed = this->apply(this->possibleChanges());
    }
    return this->finish();
  }

private:
  // Where to look.

  /// Points of bent triangles.
  bool findHotPoints()
  {
    hot_.assign(oldPoints_, false);
    bool any = false;
    for (std::size_t t = first_; t < oldTriangles_; ++t)
    {
      if (this->isBent(mesh_.triangles[t]))
      {
        any = true;
        this->heat(mesh_.triangles[t]);
      }
    }
    return any;
  }

  void heat(const Triangle& corners)
  {
    for (const Index v : corners)
    {
      hot_[v] = true;
    }
  }

  /// All triangles with a hot point.
  void findRegion()
  {
    region_.clear();
    sides_.clear();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& c = mesh_.triangles[t];
      if (!removed_[t] && (hot_[c[0]] || hot_[c[1]] || hot_[c[2]]))
      {
        region_.push_back(t);
        sides_.add(mesh_, t);
      }
    }
    sides_.sort();
  }

  bool isBent(const Triangle& c) const
  {
    const Vec3& a = mesh_.normals[c[0]];
    const Vec3& b = mesh_.normals[c[1]];
    const Vec3& d = mesh_.normals[c[2]];
    return std::min({ a.dot(b), b.dot(d), d.dot(a) }) < leastCosine_;
  }

  /// That of an edge which may be changed, or null.
  const TriangleSide* changeableTwin(const TriangleSide& side) const
  {
    if (side.from > side.to || !hot_[side.from] || !hot_[side.to] || side.triangle < first_)
    {
      return nullptr;
    }
    const TriangleSide* twin = sides_.twinOf(side);
    return twin && twin->triangle >= first_ ? twin : nullptr;
  }

  // What is there.

  void lookAtSites()
  {
    std::vector<SiteKey> keys;
    for (const TriangleSide& side : sides_.all())
    {
      if (const TriangleSide* twin = this->changeableTwin(side))
      {
        keys.push_back(this->edgeKey(side, *twin));
      }
    }
    for (const std::size_t t : region_)
    {
      const Triangle& c = mesh_.triangles[t];
      if (t >= first_ && this->isBent(c))
      {
        keys.push_back(triangleKey(c));
      }
    }
    this->lookAt(keys);
    keys.clear();
    for (const TriangleSide& side : sides_.all())
    {
      const TriangleSide* twin = this->changeableTwin(side);
      if (twin && this->notchAt(this->edgeKey(side, *twin)).height > 0.0)
      {
        keys.push_back(flipped(this->edgeKey(side, *twin)));
      }
    }
    this->lookAt(keys);
  }

  void lookAt(const std::vector<SiteKey>& keys)
  {
    std::vector<SiteKey> fresh;
    std::vector<NotchSite> sites;
    for (const SiteKey& key : keys)
    {
      if (known_.emplace(key, NotchPoint{}).second)
      {
        fresh.push_back(key);
        sites.push_back(this->siteOf(key));
      }
    }
    const std::vector<NotchPoint> points = findNotchPoints(field_, cell_, sites, progress_);
    for (std::size_t k = 0; k < fresh.size(); ++k)
    {
      known_[fresh[k]] = points[k];
    }
  }

  NotchSite siteOf(const SiteKey& key) const
  {
    NotchSite site;
    site.count = key[3] < 0 ? 3 : 4;
    for (int k = 0; k < site.count; ++k)
    {
      site.rim[k] = mesh_.points[key[k]];
      site.normals[k] = mesh_.normals[key[k]];
    }
    return site;
  }

  SiteKey edgeKey(const TriangleSide& side, const TriangleSide& twin) const
  {
    return { side.from, cornerOpposite(mesh_, twin), side.to, cornerOpposite(mesh_, side) };
  }
  static SiteKey flipped(const SiteKey& key) { return { key[1], key[2], key[3], key[0] }; }

  const NotchPoint& notchAt(const SiteKey& key) const { return known_.at(key); }

  // What to do.

  /// The highest first; triangles come after edges, since these may do for them.
  std::vector<Change> possibleChanges() const
  {
    std::vector<Change> changes;
    for (const TriangleSide& side : sides_.all())
    {
      if (const TriangleSide* twin = this->changeableTwin(side))
      {
        this->addEdge(side, *twin, changes);
      }
    }
    const auto higher = [](const Change& a, const Change& b)
    { return std::make_pair(-a.height, a.site) < std::make_pair(-b.height, b.site); };
    std::sort(changes.begin(), changes.end(), higher);
    const auto edges = static_cast<std::ptrdiff_t>(changes.size());
    for (const std::size_t t : region_)
    {
      this->addTriangle(t, changes);
    }
    std::sort(changes.begin() + edges, changes.end(), higher);
    return changes;
  }

  void addEdge(
    const TriangleSide& side, const TriangleSide& twin, std::vector<Change>& changes) const
  {
    const SiteKey site = this->edgeKey(side, twin);
    const NotchPoint& notch = this->notchAt(site);
    if (!(notch.height > 0.0) || refused_.count(site) > 0)
    {
      return;
    }
    const auto [p, s, q, r] = site;
    Change change{ site, notch.height, true, { side.triangle, twin.triangle }, {} };
    change.made = { { p, s, r }, { s, q, r } };
    const bool flips = this->notchAt(flipped(site)).off < kWorthFlip * notch.off &&
      !this->mayBeJoined(r, s) && this->looksRight(change, notch);
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

  /// By an edge; not all are known around points at the rim of the region.
  bool mayBeJoined(Index a, Index b) const
  {
    return !hot_[a] || !hot_[b] || sides_.find(a, b) || sides_.find(b, a) || sides_.isOpenAt(a) ||
      sides_.isOpenAt(b);
  }

  void addTriangle(std::size_t t, std::vector<Change>& changes) const
  {
    const auto [a, b, c] = mesh_.triangles[t];
    const SiteKey site = triangleKey(mesh_.triangles[t]);
    const auto notch = known_.find(site);
    if (notch == known_.end() || !(notch->second.height > 0.0) || refused_.count(site) > 0)
    {
      return;
    }
    Change change{ site, notch->second.height, false, { t }, {} };
    change.made = { { a, b, -1 }, { b, c, -1 }, { c, a, -1 } };
    if (this->looksRight(change, notch->second))
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

  bool apply(const std::vector<Change>& changes)
  {
    const std::size_t points = mesh_.points.size();
    const std::size_t triangles = mesh_.triangles.size();
    std::vector<const Change*> done;
    do
    {
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
    this->heatMade(triangles);
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
      mesh_.points.push_back(this->notchAt(change.site).point);
      mesh_.normals.push_back(this->notchAt(change.site).normal);
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

  void heatMade(std::size_t firstMade)
  {
    removed_.resize(mesh_.triangles.size(), false);
    hot_.resize(mesh_.points.size(), true);
    for (std::size_t t = firstMade; t < mesh_.triangles.size(); ++t)
    {
      this->heat(mesh_.triangles[t]);
    }
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

  const FieldSource& field_;
  const double cell_;
  const double leastCosine_;
  const std::size_t first_;
  TriangleMesh& mesh_;
  const Progress& progress_;
  const std::size_t oldTriangles_;
  const std::size_t oldPoints_;
  std::vector<bool> hot_;           ///< per point: of a bent triangle, or of a new one
  std::vector<bool> removed_;       ///< per triangle
  std::vector<std::size_t> region_; ///< triangles with a hot point
  TriangleSides sides_;             ///< of the region
  std::unordered_map<SiteKey, NotchPoint, SiteHash> known_;
  std::set<SiteKey> refused_;
  std::vector<SiteKey> makerOf_; ///< each triangle of this round
};

} // namespace

std::size_t mendNotches(const FieldSource& field, double cellSize, double leastCosine,
  std::size_t first, TriangleMesh& mesh, const Progress& progress)
{
  return NotchMender(field, cellSize, leastCosine, first, mesh, progress).run();
}

} // namespace hybridtree
