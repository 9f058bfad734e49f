// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/SharpCreases.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/mesh/Crossings.h"
#include "core/polygonize/CreaseLoops.h"
#include "core/polygonize/CreaseNotches.h"
#include "core/polygonize/CreasePoints.h"
#include "core/polygonize/TriangleSides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hybridtree
{
namespace
{

constexpr double kLeastAngle = 0.5236; // 30 degrees
constexpr double kLeastNear = 0.43;    // 25 degrees, seen from near
constexpr double kWorthFlip = 1e-3;    // cells that a flip must come nearer to the surface
constexpr double kLeastTilt = 0.2;     // cosine of a flipped triangle to the surface beside it
constexpr std::size_t kEdgesPerTask = 64;
constexpr double kCreaseShare = 0.6; // of the work; the rest is for notches

/// The edge of two sharpened polygons: side k of the first, and the same of the second.
struct SharedEdge
{
  std::size_t loop[2];
  std::size_t side[2];
  bool flipped = false;
};

/// A triangle of a sharpened polygon.
struct NewTriangle
{
  Triangle corners;
  std::size_t loop;    ///< it belongs to,
  std::size_t partner; ///< and that across its side, if that is sharpened too
  Vec3 normal;         ///< of the surface near it
};

class Sharpener
{
public:
  Sharpener(const FieldSource& field, const Lattice& lattice, std::size_t first, TriangleMesh& mesh,
    const Progress& progress)
    : field_(field)
    , lattice_(lattice)
    , mesh_(mesh)
    , progress_(progress)
    , loops_(findCreaseLoops(mesh, first, lattice, std::cos(kLeastAngle), progress))
  {
  }

  std::size_t run()
  {
    if (loops_.empty())
    {
      return 0;
    }
    points_ = findCreasePoints(field_, lattice_, mesh_, loops_, kLeastNear, progress_);
    if (std::none_of(
          points_.begin(), points_.end(), [](const CreasePoint& point) { return point.found; }))
    {
      return 0;
    }
    firstPoint_ = mesh_.points.size();
    for (std::size_t k = 0; k < loops_.size(); ++k)
    {
      mesh_.points.push_back(points_[k].point);
    }
    this->findSharedEdges();
    this->measureFlips();
    do
    {
      this->makeTriangles();
    } while (this->takeBackTurned() || this->takeBackCrossing());
    return this->rebuild();
  }

  bool isCalm() const
  {
    return std::none_of(points_.begin(), points_.end(),
      [](const CreasePoint& point) { return point.found || point.suspected; });
  }

  /// Triangles of the mesh as it is now, of polygons that are bent but merely curved.
  std::vector<bool> calmTriangles() const
  {
    std::vector<bool> calm(mesh_.triangles.size(), false);
    std::size_t gone = 0; // before the polygon at hand
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    {
      const auto first = static_cast<std::ptrdiff_t>(loops_[loop].firstTriangle - gone);
      if (points_[loop].found)
      {
        gone += loops_[loop].triangleCount;
      }
      else if (!points_[loop].suspected)
      {
        std::fill_n(calm.begin() + first, loops_[loop].triangleCount, true);
      }
    }
    return calm;
  }

private:
  std::int32_t apexOf(std::size_t loop) const
  {
    return static_cast<std::int32_t>(firstPoint_ + loop);
  }
  std::int32_t corner(std::size_t loop, std::size_t k) const
  {
    return loops_[loop].corners[k % loops_[loop].corners.size()];
  }
  const Vec3& cornerNormal(std::size_t loop, std::size_t k) const
  {
    return points_[loop].cornerNormals[k % loops_[loop].corners.size()];
  }

  // Flips.

  void findSharedEdges()
  {
    std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::size_t, std::size_t>> sides;
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    {
      for (std::size_t k = 0; points_[loop].found && k < loops_[loop].corners.size(); ++k)
      {
        const std::int32_t a = this->corner(loop, k);
        const std::int32_t b = this->corner(loop, k + 1);
        const auto twin = sides.find({ b, a });
        if (twin == sides.end())
        {
          sides[{ a, b }] = { loop, k };
          continue;
        }
        edges_.push_back({ { twin->second.first, loop }, { twin->second.second, k } });
      }
    }
  }

  /// Flips edges that are further from the surface than those between the crease points.
  void measureFlips()
  {
    parallelFor(edges_.size(), kEdgesPerTask,
      [&](std::size_t begin, std::size_t end)
      {
        progress_.check();
        std::vector<Vec3> middles;
        Box3 box;
        for (std::size_t k = begin; k < end; ++k)
        {
          const auto [loop, side] = std::make_pair(edges_[k].loop, edges_[k].side);
          middles.push_back(0.5 *
            (mesh_.points[this->corner(loop[0], side[0])] +
              mesh_.points[this->corner(loop[0], side[0] + 1)]));
          middles.push_back(0.5 * (points_[loop[0]].point + points_[loop[1]].point));
          box.extend(middles.back());
          box.extend(middles[middles.size() - 2]);
        }
        const std::vector<double> off = this->fieldAt(middles, box);
        for (std::size_t k = begin; k < end; ++k)
        {
          const std::size_t* loop = edges_[k].loop;
          const double slope = 0.5 * (points_[loop[0]].slope + points_[loop[1]].slope);
          const double gain = std::abs(off[2 * (k - begin)]) - std::abs(off[2 * (k - begin) + 1]);
          edges_[k].flipped = gain > kWorthFlip * lattice_.cellSize * slope;
        }
      });
    std::set<std::pair<std::size_t, std::size_t>> joined;
    for (SharedEdge& edge : edges_)
    {
      // Two polygons may share two edges, but their points not be joined twice.
      edge.flipped = edge.flipped && this->flipsWell(edge) &&
        joined.insert({ edge.loop[0], edge.loop[1] }).second;
    }
  }

  /// f - T.
  std::vector<double> fieldAt(const std::vector<Vec3>& points, const Box3& box) const
  {
    std::vector<double> values(points.size(), -kThreshold);
    const Vec3 margin = Vec3::Constant(1e-3 * lattice_.cellSize);
    if (const FieldSourcePtr near =
          field_.restrictedTo(Box3(Vec3(box.min() - margin), Vec3(box.max() + margin))))
    {
      ScratchVectors places(points.size());
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        places.batch().set(k, points[k]);
      }
      near->field(places.points(), values.data());
      for (double& value : values)
      {
        value -= kThreshold;
      }
    }
    return values;
  }

  Vec3 areaNormalOf(const Triangle& corners) const
  {
    const Vec3& a = mesh_.points[corners[0]];
    return (mesh_.points[corners[1]] - a).cross(mesh_.points[corners[2]] - a);
  }

  /// Both triangles lie on the surface beside them, and not across the crease.
  bool flipsWell(const SharedEdge& edge) const
  {
    for (const int number : { 0, 1 })
    {
      const Vec3 made = this->areaNormalOf(this->flippedTriangle(edge, number));
      if (!(made.dot(this->flippedNormal(edge, number)) > kLeastTilt * made.norm()))
      {
        return false;
      }
    }
    return true;
  }

  Vec3 flippedNormal(const SharedEdge& edge, int number) const
  {
    return this->cornerNormal(edge.loop[0], edge.side[0] + static_cast<std::size_t>(number));
  }

  /// Number 0 is at the start of side[0], and stands for the triangle of loop[0].
  Triangle flippedTriangle(const SharedEdge& edge, int number) const
  {
    const std::int32_t p = this->apexOf(edge.loop[0]);
    const std::int32_t q = this->apexOf(edge.loop[1]);
    return number == 0 ? Triangle{ p, this->corner(edge.loop[0], edge.side[0]), q }
                       : Triangle{ q, this->corner(edge.loop[0], edge.side[0] + 1), p };
  }

  // What is taken back.

  /// Polygons with a triangle that looks against the surface.
  bool takeBackTurned()
  {
    bool any = false;
    for (const NewTriangle& made : made_)
    {
      // One that has been taken back may have turned others, which are seen again.
      if (points_[made.loop].found && points_[made.partner].found &&
        this->areaNormalOf(made.corners).dot(made.normal) <= 0.0)
      {
        const bool own = this->beyondCell(made.loop) >= this->beyondCell(made.partner);
        this->takeBack(own ? made.loop : made.partner);
        any = true;
      }
    }
    return any;
  }

  void takeBack(std::size_t loop)
  {
    points_[loop].found = false;
    points_[loop].suspected = true;
  }

  double beyondCell(std::size_t loop) const
  {
    const Vec3 low = lattice_.point(loops_[loop].cell);
    const Box3 cell(low, Vec3(low + Vec3::Constant(lattice_.cellSize)));
    return cell.exteriorDistance(points_[loop].point);
  }

  /// Polygons with a triangle that crosses another one.
  bool takeBackCrossing()
  {
    std::vector<bool> removed(mesh_.triangles.size(), false);
    this->markRemoved(removed);
    const std::size_t old = removed.size();
    this->appendMade();
    const auto crossings = newCrossings(mesh_, old, removed, lattice_.cellSize);
    mesh_.triangles.resize(old);
    for (const auto& [s, t] : crossings)
    {
      for (const std::size_t triangle : { s, t })
      {
        if (triangle >= old)
        {
          this->takeBack(made_[triangle - old].loop);
        }
      }
    }
    return !crossings.empty();
  }

  void markRemoved(std::vector<bool>& removed) const
  {
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    {
      const auto first = removed.begin() + static_cast<std::ptrdiff_t>(loops_[loop].firstTriangle);
      std::fill_n(first, loops_[loop].triangleCount, points_[loop].found);
    }
  }

  // The result.

  void makeTriangles()
  {
    std::vector<std::vector<const SharedEdge*>> sharedBy(loops_.size());
    for (const SharedEdge& edge : edges_)
    {
      if (points_[edge.loop[0]].found && points_[edge.loop[1]].found)
      {
        sharedBy[edge.loop[0]].push_back(&edge);
        sharedBy[edge.loop[1]].push_back(&edge);
      }
    }
    made_.clear();
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    {
      for (std::size_t k = 0; points_[loop].found && k < loops_[loop].corners.size(); ++k)
      {
        made_.push_back({ { this->apexOf(loop), this->corner(loop, k), this->corner(loop, k + 1) },
          loop, loop, this->cornerNormal(loop, k) + this->cornerNormal(loop, k + 1) });
        for (const SharedEdge* edge : sharedBy[loop])
        {
          const int number = edge->loop[0] == loop ? 0 : 1;
          if (edge->side[number] == k)
          {
            made_.back().partner = edge->loop[1 - number];
            this->flip(*edge, number, made_.back());
          }
        }
      }
    }
  }

  void flip(const SharedEdge& edge, int number, NewTriangle& made) const
  {
    if (edge.flipped)
    {
      made.corners = this->flippedTriangle(edge, number);
      made.normal = this->flippedNormal(edge, number);
    }
  }

  void appendMade()
  {
    for (const NewTriangle& made : made_)
    {
      mesh_.triangles.push_back(made.corners);
    }
  }

  std::size_t rebuild()
  {
    std::vector<bool> removed(mesh_.triangles.size(), false);
    this->markRemoved(removed);
    this->appendMade();
    dropTriangles(mesh_, removed);
    return this->keepPoints(mesh_.triangles.size() - made_.size());
  }

  /// Leaves out the points of polygons that are not sharpened.
  std::size_t keepPoints(std::size_t firstMade)
  {
    std::vector<std::int32_t> number(loops_.size());
    std::size_t next = firstPoint_;
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    {
      number[loop] = static_cast<std::int32_t>(next);
      if (points_[loop].found)
      {
        mesh_.points[next++] = points_[loop].point;
        mesh_.normals.push_back(points_[loop].normal);
      }
    }
    mesh_.points.resize(next);
    mesh_.vertexOrigin.resize(mesh_.vertexOrigin.empty() ? 0 : next);
    for (std::size_t t = firstMade; t < mesh_.triangles.size(); ++t)
    {
      for (std::int32_t& v : mesh_.triangles[t])
      {
        const auto loop = static_cast<std::size_t>(v) - firstPoint_;
        v = static_cast<std::size_t>(v) < firstPoint_ ? v : number[loop];
      }
    }
    return next - firstPoint_;
  }

  const FieldSource& field_;
  const Lattice& lattice_;
  TriangleMesh& mesh_;
  const Progress& progress_;
  const std::vector<CreaseLoop> loops_;
  std::vector<CreasePoint> points_; ///< one for each loop; not found: it stays as it is
  std::size_t firstPoint_ = 0;      ///< of these in the mesh, while at work
  std::vector<SharedEdge> edges_;
  std::vector<NewTriangle> made_;
};

} // namespace

std::size_t sharpenCreases(const FieldSource& field, const Lattice& lattice, std::size_t first,
  TriangleMesh& mesh, const Progress& progress)
{
  const ProgressPart creases(progress, 0.0, kCreaseShare);
  Sharpener sharpener(field, lattice, first, mesh, creases);
  std::size_t points = sharpener.run();
  // What is merely curved is round and small, and to look for notches there would cost more than
  // all the rest.
  if (!sharpener.isCalm())
  {
    const NotchOptions options{ lattice.cellSize, std::cos(kLeastAngle), first,
      sharpener.calmTriangles() };
    points += mendNotches(field, options, mesh, ProgressPart(progress, kCreaseShare, 1.0));
  }
  progress.report(1.0);
  return points;
}

} // namespace hybridtree
