// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchShape.h"

#include "core/mesh/MeshLinks.h"
#include "core/stitch/CheckPatch.h"
#include "core/stitch/DropRemoved.h"
#include "core/stitch/ProjectPoints.h"
#include "core/stitch/TriangleShape.h"
#include "core/stitch/UnfoldPatch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using Index = MeshLinks::Index;

constexpr int kMaxRounds = 8;
constexpr int kMoves = 2;
constexpr double kLongestMove = 0.3; // cells, along the surface,
constexpr double kMoveReach = 0.1;   // and back onto it
constexpr double kSmooth = 0.9;      // cosine between the normals around a point that may move
constexpr double kBadShape = 0.9613; // cosine of 16 degrees
constexpr double kSliver = 0.9848;   // cosine of 10 degrees: below, a triangle's normal says little
constexpr double kWorthIt = 0.002;   // gain in that cosine
constexpr double kMostBent = 0.15;   // cells, across the four points of a flipped edge
constexpr double kMostOff = 0.05;    // cells, between old and new surface,
constexpr double kMostOffCrease = 0.01; // and where a point of a crease goes
constexpr double kThick = 0.005;        // cells
constexpr double kLargestTurn = 0.8;    // cosine, of the normal of a triangle,
constexpr double kLargestTilt = 0.6;    // or of one to the normals of its points
constexpr double kFlatEnough = 0.94;    // cosine of the angle across an edge that may be flipped
constexpr double kLongestSide = 1.6;    // cells, of a triangle that had shorter ones

Vec3 normalOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return (b - a).cross(c - a);
}

class ShapeImprover
{
public:
  ShapeImprover(const FieldSource& field, TriangleMesh& mesh, std::size_t keptPoints,
    std::vector<bool>& onCrease, double cellSize)
    : field_(field)
    , mesh_(mesh)
    , firstOwn_(static_cast<Index>(keptPoints))
    , onCrease_(onCrease)
    , cellSize_(cellSize)
    , links_(mesh.triangles, mesh.points.size())
    , touched_(links_.triangleCount(), false)
    , waiting_(links_.triangleCount(), true)
    , shapes_(links_.triangleCount(), -1.0)
  {
  }

  void run(Folds folds)
  {
    this->mendAll();
    for (int round = 0; round < kMoves && this->moveAll(); ++round)
    {
      this->mendAll();
    }
    if (folds == Folds::Unfold)
    {
      this->unfoldAll();
    }
    dropRemoved(links_, touched_, static_cast<std::size_t>(firstOwn_), mesh_, onCrease_);
  }

private:
  const Vec3& point(Index v) const { return mesh_.points[v]; }
  bool isOwn(Index v) const { return v >= firstOwn_; }
  bool isCreasePoint(Index v) const { return onCrease_[static_cast<std::size_t>(v)]; }

  /// One that is turned over is as bad as one without area, and its normal says as little: left, it
  /// would be a fault.
  double shape(std::size_t t) const
  {
    double& known = shapes_[t];
    if (known < 0.0)
    {
      const Triangle& c = links_.triangle(t);
      known =
        isTurned(mesh_, c) ? 1.0 : shapeOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
    }
    return known;
  }

  /// A triangle has other corners, or corners elsewhere.
  void change(Index t)
  {
    shapes_[t] = -1.0;
    touched_[t] = true;
    waiting_[t] = true;
  }
  Vec3 normal(std::size_t t) const
  {
    const Triangle& c = links_.triangle(t);
    return normalOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
  }
  double length(Index h) const
  {
    return (this->point(links_.from(h)) - this->point(links_.to(h))).norm();
  }

  void mendAll()
  {
    for (int round = 0; round < kMaxRounds; ++round)
    {
      bool any = false;
      for (std::size_t t = 0; t < links_.triangleCount(); ++t)
      {
        if (waiting_[t])
        {
          waiting_[t] = false;
          any = (!links_.isRemoved(t) && this->shape(t) > kBadShape && this->mend(t)) || any;
        }
      }
      if (!any)
      {
        return;
      }
    }
  }

  void unfoldAll()
  {
    const std::vector<std::size_t> changed =
      unfoldTriangles(links_, mesh_, static_cast<std::size_t>(firstOwn_), onCrease_, cellSize_);
    for (const std::size_t t : changed)
    {
      this->change(static_cast<Index>(t));
      for (int k = 0; k < 3 && !links_.isRemoved(t); ++k)
      {
        this->awaken(links_.triangle(t)[k]);
      }
    }
    if (!changed.empty())
    {
      this->mendAll();
    }
  }

  /// The triangles around a point have changed, or what is around them has.
  void awaken(Index v)
  {
    if (links_.isLocked(v))
    {
      return;
    }
    links_.forEachLeaving(v, [&](Index h) { waiting_[h / 3] = true; });
  }

  /// Moves own points of bad triangles along the surface towards the middle of their neighbours.
  bool moveAll()
  {
    std::vector<Index> moving;
    std::vector<bool> known(mesh_.points.size(), false);
    for (std::size_t t = 0; t < links_.triangleCount(); ++t)
    {
      if (links_.isRemoved(t) || this->shape(t) <= kBadShape)
      {
        continue;
      }
      for (const Index v : links_.triangle(t))
      {
        if (!known[v] && this->isOwn(v) && !this->isCreasePoint(v) && !links_.isLocked(v) &&
          !this->isOnCrease(v))
        {
          moving.push_back(v);
        }
        known[v] = true;
      }
    }
    TriangleMesh moved;
    std::vector<std::size_t> all;
    for (const Index v : moving)
    {
      all.push_back(moved.points.size());
      moved.points.push_back(this->middleAround(v));
      moved.normals.push_back(mesh_.normals[v]);
    }
    const std::vector<char> found = projectPoints(field_, all, kMoveReach * cellSize_, moved);
    bool any = false;
    for (std::size_t k = 0; k < moving.size(); ++k)
    {
      any = (found[k] && this->move(moving[k], moved.points[k], moved.normals[k])) || any;
    }
    return any;
  }

  bool isOnCrease(Index v) const
  {
    Vec3 first = Vec3::Zero();
    bool crease = false;
    links_.forEachLeaving(v,
      [&](Index h)
      {
        const auto t = static_cast<std::size_t>(h / 3);
        if (this->shape(t) < kSliver)
        {
          const Vec3 normal = this->normal(t).normalized();
          first = first.isZero(0.0) ? normal : first;
          crease = crease || first.dot(normal) < kSmooth;
        }
      });
    return crease;
  }

  Vec3 middleAround(Index v) const
  {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    links_.forEachLeaving(v,
      [&](Index h)
      {
        sum += this->point(links_.to(h));
        ++count;
      });
    const Vec3& up = mesh_.normals[v];
    Vec3 way = sum / count - this->point(v);
    way -= up.dot(way) * up;
    const double length = way.norm();
    return this->point(v) + way * std::min(1.0, kLongestMove * cellSize_ / length);
  }

  bool move(Index v, const Vec3& target, const Vec3& up)
  {
    double before = 0.0;
    double after = 0.0;
    bool allowed = true;
    links_.forEachLeaving(v,
      [&](Index h)
      {
        const Index b = links_.to(h);
        const Index c = links_.opposite(h);
        before += badness(this->shape(h / 3));
        after += badness(shapeOf(target, this->point(b), this->point(c)));
        const Vec3 turned = normalOf(target, this->point(b), this->point(c));
        const Vec3 around = up + mesh_.normals[b] + mesh_.normals[c];
        allowed = allowed && turned.dot(around) > kLargestTilt * turned.norm() * around.norm();
      });
    if (!allowed || after > before - kWorthIt)
    {
      return false;
    }
    mesh_.points[v] = target;
    mesh_.normals[v] = up;
    if (!mesh_.vertexOrigin.empty())
    {
      mesh_.vertexOrigin[v] = {};
    }
    links_.forEachLeaving(v, [&](Index h) { this->change(h / 3); });
    return true;
  }

  /// The best of all collapses and flips of a triangle's sides.
  bool mend(std::size_t t)
  {
    double best = kWorthIt;
    Index chosen = MeshLinks::kNone;
    bool flip = false;
    for (auto h = static_cast<Index>(3 * t); h < static_cast<Index>(3 * t + 3); ++h)
    {
      const Index twin = links_.twin(h);
      if (twin == MeshLinks::kNone)
      {
        continue;
      }
      for (const Index way : { h, twin })
      {
        const double gain = this->gainOfCollapse(way, best);
        if (gain > best && links_.canCollapse(way))
        {
          best = gain;
          chosen = way;
          flip = false;
        }
      }
      const double gain = this->gainOfFlip(h, twin, best);
      if (gain > best && links_.canFlip(h))
      {
        best = gain;
        chosen = h;
        flip = true;
      }
    }
    if (chosen == MeshLinks::kNone)
    {
      return false;
    }
    const Index from = links_.from(chosen);
    const Index to = links_.to(chosen);
    if (flip)
    {
      const Index twin = links_.twin(chosen);
      this->change(chosen / 3);
      this->change(twin / 3);
      const Index ends[2] = { links_.opposite(chosen), links_.opposite(twin) };
      links_.flip(chosen);
      for (const Index v : { from, to, ends[0], ends[1] })
      {
        this->awaken(v);
      }
      return true;
    }
    links_.forEachLeaving(from, [&](Index leaving) { this->change(leaving / 3); });
    links_.collapse(chosen);
    this->awaken(to);
    return true;
  }

  /// By how much the shapes around the start of h get better; 0 when it may not go, or when that is
  /// no more than `least`. What is quick to tell comes first: most may not go.
  double gainOfCollapse(Index h, double least) const
  {
    const Index from = links_.from(h);
    const Index to = links_.to(h);
    if (!this->isOwn(from) || links_.isLocked(from) || links_.isLocked(to) ||
      this->length(h) > 0.7 * cellSize_)
    {
      return 0.0;
    }
    const Vec3& target = this->point(to);
    const double mostOff = (this->isCreasePoint(from) ? kMostOffCrease : kMostOff) * cellSize_;
    if (!(std::abs(mesh_.normals[from].dot(target - this->point(from))) <= 2.0 * mostOff))
    {
      return 0.0;
    }
    double before = 0.0;
    links_.forEachLeaving(
      from, [&](Index leaving) { before += badness(this->shape(leaving / 3)); });
    if (before <= least)
    {
      return 0.0;
    }
    double after = 0.0;
    bool allowed = true;
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        const Index b = links_.to(leaving);
        const Index c = links_.opposite(leaving);
        if (allowed && b != to && c != to)
        {
          after += badness(shapeOf(target, this->point(b), this->point(c)));
          allowed = !(before - after <= least);
        }
      });
    return allowed && this->staysOnSurface(from, to, mostOff) ? before - after : 0.0;
  }

  /// Whether the triangles around a point hardly move, nor turn, nor get too long, when it goes to
  /// another one of theirs.
  bool staysOnSurface(Index from, Index to, double mostOff) const
  {
    const Vec3& target = this->point(to);
    bool allowed = true;
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        if (!allowed)
        {
          return;
        }
        const auto t = static_cast<std::size_t>(leaving / 3);
        const Index b = links_.to(leaving);
        const Index c = links_.opposite(leaving);
        const Vec3 old = this->normal(t);
        const double size = old.norm();
        const bool solid = this->shape(t) < kSliver && size > 0.0;
        const bool tells = solid || (this->isCreasePoint(from) && this->isThick(leaving, size));
        if (tells && std::abs(old.dot(target - this->point(b))) > mostOff * size)
        {
          allowed = false;
          return;
        }
        if (b == to || c == to)
        {
          return;
        }
        const Vec3 turned = normalOf(target, this->point(b), this->point(c));
        const Vec3 reference = solid ? old : this->meanNormal(b, c, to);
        const double cosine = solid ? kLargestTurn : kLargestTilt;
        allowed = turned.dot(reference) > cosine * turned.norm() * reference.norm() &&
          this->isShort((this->point(b) - target).norm(), from);
      });
    return allowed;
  }

  /// Against the sides at a point.
  bool isShort(double length, Index point) const
  {
    bool is = length <= kLongestSide * cellSize_;
    if (!is)
    {
      links_.forEachLeaving(point, [&](Index h) { is = is || length <= this->length(h); });
    }
    return is;
  }

  /// A triangle, of half this size, whose normal says where a crease is, sliver or not.
  bool isThick(Index h, double size) const
  {
    const double longest = std::max(
      { this->length(h), this->length(MeshLinks::next(h)), this->length(MeshLinks::previous(h)) });
    return size > kThick * cellSize_ * longest;
  }

  Vec3 meanNormal(Index a, Index b, Index c) const
  {
    return mesh_.normals[a] + mesh_.normals[b] + mesh_.normals[c];
  }

  /// The same of a flip.
  double gainOfFlip(Index h, Index twin, double least) const
  {
    const Index ia = links_.from(h);
    const Index ib = links_.to(h);
    const Index ic = links_.opposite(h);
    const Index id = links_.opposite(twin);
    const Vec3& a = this->point(ia);
    const Vec3& b = this->point(ib);
    const Vec3& c = this->point(ic);
    const Vec3& d = this->point(id);
    const double shapes[2] = { this->shape(h / 3), this->shape(twin / 3) };
    const double before = badness(shapes[0]) + badness(shapes[1]);
    if (before <= least)
    {
      return 0.0;
    }
    const double after = badness(shapeOf(d, b, c)) + badness(shapeOf(c, a, d));
    if (before - after <= least)
    {
      return 0.0;
    }
    if ((c - d).norm() > std::max(kLongestSide * cellSize_, (a - b).norm()))
    {
      return 0.0;
    }
    const Vec3 first = normalOf(a, b, c);
    const Vec3 second = normalOf(b, a, d);
    const bool solid = shapes[0] < kSliver && shapes[1] < kSliver;
    if (solid && first.dot(second) < kFlatEnough * first.norm() * second.norm())
    {
      return 0.0;
    }
    // Slivers have no normal to speak of; the surface has.
    const Vec3 both =
      solid ? Vec3(first + second) : Vec3(this->meanNormal(ia, ib, ic) + mesh_.normals[id]);
    const double cosine = solid ? kLargestTurn : kLargestTilt;
    const auto agrees = [&](const Vec3& made)
    { return made.dot(both) > cosine * made.norm() * both.norm(); };
    const double off = both.dot(c - a) * both.dot(d - a) > 0.0
      ? std::max(std::abs(both.dot(c - a)), std::abs(both.dot(d - a)))
      : std::abs(both.dot(c - d));
    const bool crease = this->isCreasePoint(ia) && this->isCreasePoint(ib);
    const bool near = off <= (crease ? kMostOffCrease : kMostBent) * cellSize_ * both.norm();
    return near && agrees(normalOf(d, b, c)) && agrees(normalOf(c, a, d)) ? before - after : 0.0;
  }

  const FieldSource& field_;
  TriangleMesh& mesh_;
  const Index firstOwn_;
  std::vector<bool>& onCrease_;
  const double cellSize_;
  MeshLinks links_;
  std::vector<bool> touched_;
  std::vector<bool> waiting_;          ///< to be looked at
  mutable std::vector<double> shapes_; ///< negative: not known
};

} // namespace

void improveShapes(const FieldSource& field, TriangleMesh& mesh, std::size_t keptPoints,
  std::vector<bool>& onCrease, double cellSize, Folds folds)
{
  if (!mesh.triangles.empty())
  {
    ShapeImprover(field, mesh, keptPoints, onCrease, cellSize).run(folds);
  }
}

} // namespace hybridtree
