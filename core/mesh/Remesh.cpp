// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Remesh.h"

#include "core/base/Error.h"
#include "core/mesh/CompactMesh.h"
#include "core/mesh/MeshLinks.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using Index = MeshLinks::Index;

constexpr double kLongEdge = 4.0 / 3.0; // edge lengths L
constexpr double kDegrees = 0.017453292519943295;
constexpr double kLargestTurn = 0.5; // cosine of 60 degrees
constexpr double kFlatEnough = 0.9;  // cosine of the angle across an edge that may be flipped
constexpr double kSliver = 0.99;     // cosine of a smallest angle whose normal means nothing
constexpr double kWorthIt = 0.02;    // gain in that cosine for which an edge is flipped
constexpr double kMaxTriangles = 1e8;
constexpr int kMaxSplitPasses = 40;
constexpr std::size_t kStepsPerLook = 1024;

/// Cosine of the smallest angle: 0.5 at best, 1 without area.
double shapeOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  std::array<double, 3> squared{ (b - a).squaredNorm(), (c - b).squaredNorm(),
    (a - c).squaredNorm() };
  std::sort(squared.begin(), squared.end());
  const double scale = 2.0 * std::sqrt(squared[1]) * std::sqrt(squared[2]);
  return scale > 0.0 ? (squared[1] + squared[2] - squared[0]) / scale : 1.0;
}

Vec3 normalOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return (b - a).cross(c - a);
}

bool turnsTooFar(const Vec3& before, const Vec3& after)
{
  return !(before.dot(after) >= kLargestTurn * before.norm() * after.norm()) ||
    !(after.squaredNorm() > 0.0);
}

void checkOptions(const RemeshOptions& options)
{
  if (!(options.edgeLength > 0.0) || !std::isfinite(options.edgeLength))
  {
    throw InvalidParameter("EdgeLength", options.edgeLength, "a finite length > 0");
  }
  if (!(options.shortEdge >= 0.0 && options.shortEdge <= 0.7))
  {
    throw InvalidParameter("The share for short edges", options.shortEdge, "from 0 to 0.7");
  }
  if (!(options.badAngle >= 0.0 && options.badAngle <= 30.0))
  {
    throw InvalidParameter("The bad angle", options.badAngle, "from 0 to 30 degrees");
  }
}

class Remesher
{
public:
  Remesher(TriangleMesh& mesh, const RemeshOptions& options, const ProjectToSurface& project,
    const Progress& progress)
    : mesh_(mesh)
    , options_(options)
    , project_(project)
    , progress_(progress)
    , longSquared_(std::pow(kLongEdge * options.edgeLength, 2.0))
    , shortSquared_(std::pow(options.shortEdge * options.edgeLength, 2.0))
    , badShape_(std::cos(kDegrees * options.badAngle))
    , links_(mesh.triangles, mesh.points.size())
    , touched_(mesh.triangles.size(), false)
  {
  }

  void run()
  {
    this->requireCountable();
    for (int round = 0; round < options_.maxRounds; ++round)
    {
      progress_.check();
      progress_.report(static_cast<double>(round) / options_.maxRounds);
      const bool split = this->splitLongEdges();
      const bool collapsed = this->collapseShortEdges();
      const bool flipped = this->flipEdges();
      this->projectWaiting();
      if (!split && !collapsed && !flipped)
      {
        break;
      }
    }
    this->pack();
  }

private:
  const Vec3& point(Index p) const { return mesh_.points[p]; }

  double squaredLength(Index h) const
  {
    return (this->point(links_.to(h)) - this->point(links_.from(h))).squaredNorm();
  }

  double shape(std::size_t t) const
  {
    const Triangle& c = links_.triangle(t);
    return shapeOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
  }

  Vec3 normal(std::size_t t) const
  {
    const Triangle& c = links_.triangle(t);
    return normalOf(this->point(c[0]), this->point(c[1]), this->point(c[2]));
  }

  std::int32_t leaf(Index h) const
  {
    return mesh_.sourceLeaf.empty() ? 0 : mesh_.sourceLeaf[h / 3];
  }

  void requireCountable() const
  {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      this->lookForStop(t);
      area += this->normal(t).norm();
    }
    const double count = area / (options_.edgeLength * options_.edgeLength);
    if (!(count < kMaxTriangles))
    {
      throw TooLarge("An edge length of " + std::to_string(options_.edgeLength) + " makes some " +
        std::to_string(count) + " triangles; the limit is " + std::to_string(kMaxTriangles) +
        ". Use a longer one.");
    }
  }

  void lookForStop(std::size_t step) const
  {
    if (step % kStepsPerLook == 0)
    {
      progress_.check();
    }
  }

  // Split.

  bool splitLongEdges()
  {
    for (int pass = 0; pass < kMaxSplitPasses; ++pass)
    {
      progress_.check();
      const std::vector<Index> edges = this->longEdges();
      if (edges.empty())
      {
        return pass > 0;
      }
      this->split(edges);
    }
    return true;
  }

  /// The long edges that are the longest of their triangles, one half-edge of each: no two of them
  /// share a triangle, and triangles get no worse by much.
  std::vector<Index> longEdges() const
  {
    const auto longest = [this](std::size_t t)
    {
      auto best = static_cast<Index>(3 * t);
      for (Index h = best + 1; h < static_cast<Index>(3 * t + 3); ++h)
      {
        best = this->isLonger(h, best) ? h : best;
      }
      return best;
    };
    std::vector<Index> edges;
    for (std::size_t t = 0; t < links_.triangleCount(); ++t)
    {
      this->lookForStop(t);
      if (links_.isRemoved(t))
      {
        continue;
      }
      const Index h = longest(t);
      const Index twin = links_.twin(h);
      const bool first = twin == MeshLinks::kNone ||
        (h < twin && longest(static_cast<std::size_t>(twin / 3)) == twin);
      if (first && this->squaredLength(h) > longSquared_)
      {
        edges.push_back(h);
      }
    }
    return edges;
  }

  /// A strict order that both triangles of an edge see alike.
  bool isLonger(Index h, Index other) const
  {
    const double a = this->squaredLength(h);
    const double b = this->squaredLength(other);
    if (a != b)
    {
      return a > b;
    }
    const auto ends = [this](Index edge) {
      return std::minmax({ links_.from(edge), links_.to(edge) });
    };
    return ends(h) > ends(other);
  }

  void split(const std::vector<Index>& edges)
  {
    for (const Index h : edges)
    {
      this->addMiddle(links_.from(h), links_.to(h));
      const Index twin = links_.twin(h);
      waiting_.push_back(static_cast<Index>(mesh_.points.size() - 1));
      links_.split(h, waiting_.back());
      this->copyTriangle(h);
      if (twin != MeshLinks::kNone)
      {
        this->copyTriangle(twin);
      }
    }
    this->projectWaiting();
  }

  void addMiddle(Index a, Index b)
  {
    mesh_.points.push_back(0.5 * (this->point(a) + this->point(b)));
    if (!mesh_.normals.empty())
    {
      const Vec3 sum = mesh_.normals[a] + mesh_.normals[b];
      const double length = sum.norm();
      mesh_.normals.push_back(length > 0.0 ? Vec3(sum / length) : mesh_.normals[a]);
    }
    if (!mesh_.vertexOrigin.empty())
    {
      VertexOrigin origin;
      const VertexOrigin& from = mesh_.vertexOrigin[a];
      const VertexOrigin& to = mesh_.vertexOrigin[b];
      if (!project_ && from.leaf == to.leaf && from.triangle == to.triangle)
      {
        origin = { from.leaf, from.triangle, 0.5 * (from.u + to.u), 0.5 * (from.v + to.v) };
      }
      mesh_.vertexOrigin.push_back(origin);
    }
  }

  void copyTriangle(Index h)
  {
    touched_[h / 3] = true;
    touched_.push_back(true);
    if (!mesh_.sourceLeaf.empty())
    {
      mesh_.sourceLeaf.push_back(mesh_.sourceLeaf[h / 3]);
    }
    if (!mesh_.sourceTriangle.empty())
    {
      mesh_.sourceTriangle.push_back(mesh_.sourceTriangle[h / 3]);
    }
  }

  /// Moves the waiting points onto the surface, unless a triangle there would turn too far: those
  /// wait on, for better triangles.
  void projectWaiting()
  {
    if (!project_ || waiting_.empty())
    {
      return;
    }
    const bool hasNormals = !mesh_.normals.empty();
    std::vector<Vec3> points(waiting_.size());
    std::vector<Vec3> normals(waiting_.size(), Vec3::Zero());
    for (std::size_t k = 0; k < waiting_.size(); ++k)
    {
      points[k] = this->point(waiting_[k]);
      normals[k] = hasNormals ? mesh_.normals[waiting_[k]] : normals[k];
    }
    project_(points, normals);
    std::size_t left = 0;
    for (std::size_t k = 0; k < waiting_.size(); ++k)
    {
      const Index p = waiting_[k];
      if (links_.isLocked(p)) // on a border, or collapsed
      {
        continue;
      }
      if (!points[k].allFinite() || !this->canMove(p, points[k]))
      {
        waiting_[left++] = p;
        continue;
      }
      mesh_.points[p] = points[k];
      if (hasNormals && normals[k].allFinite())
      {
        mesh_.normals[p] = normals[k];
      }
    }
    waiting_.resize(left);
  }

  bool canMove(Index p, const Vec3& target) const
  {
    bool good = true;
    links_.forEachLeaving(p,
      [&](Index h)
      {
        const Vec3& b = this->point(links_.to(h));
        const Vec3& c = this->point(links_.opposite(h));
        good = good && !turnsTooFar(normalOf(this->point(p), b, c), normalOf(target, b, c));
      });
    return good;
  }

  // Collapse.

  bool collapseShortEdges()
  {
    bool any = false;
    for (std::size_t t = 0; t < links_.triangleCount(); ++t)
    {
      this->lookForStop(t);
      if (links_.isRemoved(t) || this->shape(t) < badShape_)
      {
        continue;
      }
      auto h = static_cast<Index>(3 * t);
      for (Index other = h + 1; other < static_cast<Index>(3 * t + 3); ++other)
      {
        h = this->squaredLength(other) < this->squaredLength(h) ? other : h;
      }
      if (this->squaredLength(h) < shortSquared_)
      {
        any = this->collapse(h) || any;
      }
    }
    return any;
  }

  /// Towards the end that leaves the better triangles.
  bool collapse(Index h)
  {
    if (!links_.canCollapse(h)) // the same for both directions
    {
      return false;
    }
    const Index twin = links_.twin(h);
    const double forth = this->gainOfCollapse(h);
    const double back = this->gainOfCollapse(twin);
    if (std::max(forth, back) <= 0.0)
    {
      return false;
    }
    const Index chosen = forth >= back ? h : twin;
    const Index end = links_.to(chosen);
    links_.collapse(chosen);
    links_.forEachLeaving(end, [&](Index leaving) { this->markChanged(leaving); });
    return true;
  }

  /// By how much the worst shape around the start of h gets better; 0 or less when it may not go.
  double gainOfCollapse(Index h) const
  {
    const Index from = links_.from(h);
    const Index to = links_.to(h);
    const Vec3& target = this->point(to);
    double before = 0.0;
    double after = 0.0;
    Vec3 around = Vec3::Zero();
    links_.forEachLeaving(
      from, [&](Index leaving) { around += this->normal(static_cast<std::size_t>(leaving / 3)); });
    bool allowed = true;
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        const auto t = static_cast<std::size_t>(leaving / 3);
        const Index b = links_.to(leaving);
        const Index c = links_.opposite(leaving);
        const double shape = this->shape(t);
        before = std::max(before, shape);
        allowed = allowed && this->leaf(leaving) == this->leaf(h);
        if (b == to || c == to)
        {
          return;
        }
        const Vec3 turned = normalOf(target, this->point(b), this->point(c));
        const Vec3 old = shape > kSliver ? around : this->normal(t);
        const double length = (this->point(b) - target).squaredNorm();
        allowed = allowed && !turnsTooFar(old, turned) &&
          length <= std::max(longSquared_, this->squaredLength(leaving));
        after = std::max(after, shapeOf(target, this->point(b), this->point(c)));
      });
    return allowed ? before - after : 0.0;
  }

  void markChanged(Index h)
  {
    touched_[h / 3] = true;
    if (!mesh_.sourceTriangle.empty())
    {
      mesh_.sourceTriangle[h / 3] = -1;
    }
  }

  // Flip.

  bool flipEdges()
  {
    bool any = false;
    for (std::size_t t = 0; t < links_.triangleCount(); ++t)
    {
      this->lookForStop(t);
      if (links_.isRemoved(t) || !(touched_[t] || this->shape(t) > badShape_))
      {
        continue;
      }
      for (auto h = static_cast<Index>(3 * t); h < static_cast<Index>(3 * t + 3); ++h)
      {
        if (this->isBetterFlipped(h))
        {
          this->markChanged(h);
          this->markChanged(links_.twin(h));
          links_.flip(h);
          any = true;
          break;
        }
      }
    }
    return any;
  }

  bool isBetterFlipped(Index h) const
  {
    const Index twin = links_.twin(h);
    if (twin == MeshLinks::kNone || this->leaf(h) != this->leaf(twin))
    {
      return false;
    }
    const Vec3& a = this->point(links_.from(h));
    const Vec3& b = this->point(links_.to(h));
    const Vec3& c = this->point(links_.opposite(h));
    const Vec3& d = this->point(links_.opposite(twin));
    const double before = std::max(shapeOf(a, b, c), shapeOf(b, a, d));
    const double after = std::max(shapeOf(d, b, c), shapeOf(c, a, d));
    if (after > before - kWorthIt ||
      (c - d).squaredNorm() > std::max(longSquared_, (a - b).squaredNorm()))
    {
      return false;
    }
    const Vec3 first = normalOf(a, b, c);
    const Vec3 second = normalOf(b, a, d);
    const bool flat =
      before > kSliver || first.dot(second) >= kFlatEnough * first.norm() * second.norm();
    const Vec3 both = first + second;
    return flat && !turnsTooFar(both, normalOf(d, b, c)) && !turnsTooFar(both, normalOf(c, a, d)) &&
      links_.canFlip(h);
  }

  // Result.

  /// Writes the triangles that are left back.
  void pack()
  {
    std::vector<bool> keep(links_.triangleCount());
    mesh_.triangles.resize(keep.size());
    for (std::size_t t = 0; t < keep.size(); ++t)
    {
      this->lookForStop(t);
      keep[t] = !links_.isRemoved(t);
      mesh_.triangles[t] = links_.triangle(t);
    }
    keepTriangles(mesh_, keep);
  }

  TriangleMesh& mesh_;
  const RemeshOptions& options_;
  const ProjectToSurface& project_;
  const Progress& progress_;
  const double longSquared_;
  const double shortSquared_;
  const double badShape_;
  MeshLinks links_;
  std::vector<Index> waiting_; ///< new points that are not on the surface yet
  std::vector<bool> touched_;  ///< changed by us: flips may go on from there
};

} // namespace

void remeshStretched(TriangleMesh& mesh, const RemeshOptions& options,
  const ProjectToSurface& project, const Progress& progress)
{
  checkOptions(options);
  Remesher(mesh, options, project, progress).run();
}

} // namespace hybridtree
