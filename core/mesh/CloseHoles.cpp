// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/CloseHoles.h"

#include "core/geometry/Predicates.h"
#include "core/mesh/BestTriangulation.h"
#include "core/mesh/HalfEdges.h"
#include "core/mesh/Orient.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace hybridtree
{
namespace
{

using Loop = std::vector<std::int32_t>;

// ---------------------------------------------------------------------------- loops

/// The loops of open edges as new triangles have to run along them, none of which passes a point
/// twice.
class Loops
{
public:
  explicit Loops(const std::vector<Triangle>& triangles)
    : triangles_(triangles), edges_(halfEdges(triangles)), passed_(edges_.opposite.size())
  {
    for (std::size_t h = 0; h < passed_.size(); ++h)
    {
      if (edges_.opposite[h] == HalfEdges::kOpen && !passed_[h])
      {
        this->follow(std::int32_t(h));
      }
    }
  }

  std::vector<Loop> found;
  std::size_t lost = 0; ///< that come to where the mesh is no oriented 2-manifold

private:
  std::int32_t from(std::int32_t h) const { return triangles_[h / 3][h % 3]; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// The open edge that arrives where h leaves, around the fan between them; below 0 where there is
  /// none.
  std::int32_t before(std::int32_t h) const
  {
    const std::int32_t point = this->from(h);
    std::int32_t arriving = previous(h);
    while (edges_.opposite[arriving] != HalfEdges::kOpen)
    {
      const std::int32_t leaving = edges_.opposite[arriving];
      if (leaving < 0 || this->from(leaving) != point)
      {
        return -1;
      }
      arriving = previous(leaving);
    }
    return arriving;
  }

  void follow(std::int32_t first)
  {
    Loop way;
    std::int32_t h = first;
    do
    {
      passed_[h] = true;
      way.push_back(this->from(h));
      h = this->before(h);
    } while (h >= 0 && h != first && !passed_[h]);
    h == first ? this->part(way) : void(++lost);
  }

  /// Cuts a loop off wherever it comes to a point for the second time.
  void part(const Loop& whole)
  {
    Loop way;
    std::unordered_map<std::int32_t, std::size_t> place;
    const auto cutOff = [&](std::size_t begin)
    {
      const auto at = way.begin() + std::ptrdiff_t(begin);
      if (way.end() - at > 2)
      {
        found.emplace_back(at, way.end());
      }
      std::for_each(at, way.end(), [&](std::int32_t point) { place.erase(point); });
      way.erase(at, way.end());
    };
    for (const std::int32_t point : whole)
    {
      const auto met = place.find(point);
      if (met != place.end())
      {
        cutOff(met->second);
      }
      place[point] = way.size();
      way.push_back(point);
    }
    cutOff(0);
  }

  const std::vector<Triangle>& triangles_;
  const HalfEdges edges_;
  std::vector<bool> passed_;
};

// ---------------------------------------------------------------------------- edges

/// Edges between points of loops: no other triangle may be joined to one of them.
class Edges
{
public:
  Edges(const TriangleMesh& mesh, const std::vector<Loop>& loops) : onLoop_(mesh.points.size())
  {
    for (const Loop& loop : loops)
    {
      for (const std::int32_t point : loop)
      {
        onLoop_[std::size_t(point)] = true;
      }
    }
    std::for_each(mesh.triangles.begin(), mesh.triangles.end(),
      [this](const Triangle& triangle) { this->add(triangle); });
  }

  void add(const Triangle& corner)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int32_t a = corner[k];
      const std::int32_t b = corner[(k + 1) % 3];
      if (this->isOnLoop(a) && this->isOnLoop(b))
      {
        edges_.insert(key(a, b));
      }
    }
  }

  bool has(std::int32_t a, std::int32_t b) const { return edges_.count(key(a, b)) > 0; }

private:
  static std::uint64_t key(std::int32_t a, std::int32_t b)
  {
    return std::uint64_t(std::min(a, b)) << 32 | std::uint64_t(std::max(a, b));
  }

  bool isOnLoop(std::int32_t point) const
  {
    return std::size_t(point) < onLoop_.size() && onLoop_[std::size_t(point)];
  }

  std::vector<bool> onLoop_;
  std::unordered_set<std::uint64_t> edges_;
};

// ---------------------------------------------------------------------------- triangles

/// The triangles of smallest area over a loop.
class LeastArea
{
public:
  LeastArea(const std::vector<Vec3>& points, const Edges& edges) : points_(points), edges_(edges) {}

  /// False where the loop cannot be closed without more points. \throws Cancelled
  bool close(const Loop& loop, const Progress& progress)
  {
    triangles.clear();
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      sum += (this->at(loop[k]) - this->at(loop[(k + 1) % loop.size()])).squaredNorm();
    }
    unit_ = sum / double(loop.size());
    count_ = loop.size();
    return this->fill(loop, progress);
  }

  std::vector<Triangle> triangles;

private:
  static constexpr std::size_t kMost = 400;
  static constexpr std::size_t kLongestStep = 20; ///< each pocket takes the cube of its length

  const Vec3& at(std::int32_t point) const { return points_[std::size_t(point)]; }

  /// A loop of more points has the pockets between every n-th of them filled first.
  bool fill(const Loop& loop, const Progress& progress)
  {
    progress.report(double(triangles.size()) / double(count_));
    progress.check();
    if (loop.size() <= kMost)
    {
      return this->fillBest(loop);
    }
    const std::size_t step = std::min((loop.size() + kMost - 1) / kMost, kLongestStep);
    Loop coarse;
    for (std::size_t begin = 0; begin < loop.size(); begin += step)
    {
      coarse.push_back(loop[begin]);
      Loop pocket;
      for (std::size_t k = begin; k <= std::min(begin + step, loop.size()); ++k)
      {
        pocket.push_back(loop[k % loop.size()]);
      }
      if (pocket.size() > 2 &&
        (edges_.has(pocket.front(), pocket.back()) || !this->fill(pocket, progress)))
      {
        return false;
      }
    }
    return this->fill(coarse, progress);
  }

  bool fillBest(const Loop& loop)
  {
    const bool found = best_.find(
      loop.size(),
      [&](std::size_t i, std::size_t k, std::size_t j)
      { return this->cost(loop[i], loop[k], loop[j]); },
      [&](std::size_t i, std::size_t j) { return !edges_.has(loop[i], loop[j]); });
    for (const auto& [i, k, j] : best_.triangles)
    {
      triangles.push_back({ loop[i], loop[k], loop[j] });
    }
    return found;
  }

  /// Area, and a tenth of a mean square for a needle. \returns infinity for points on one line.
  double cost(std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    const Vec3 u = this->at(b) - this->at(a);
    const Vec3 v = this->at(c) - this->at(b);
    const Vec3 w = this->at(a) - this->at(c);
    const double twice = u.cross(v).norm();
    double squares[3] = { u.squaredNorm(), v.squaredNorm(), w.squaredNorm() };
    std::sort(squares, squares + 3);
    if (!(twice > 1e-10 * squares[2]) && collinear(this->at(a), this->at(b), this->at(c)))
    {
      return BestTriangulation::kNever;
    }
    const double product = 2.0 * std::sqrt(squares[1] * squares[2]);
    const double cosine = (squares[1] + squares[2] - squares[0]) / product; // of the smallest angle
    const double fourth = cosine * cosine * cosine * cosine;
    return 0.5 * twice + 0.1 * unit_ * fourth * fourth;
  }

  const std::vector<Vec3>& points_;
  const Edges& edges_;
  double unit_ = 0.0;     ///< mean square of the edges of the loop
  std::size_t count_ = 1; ///< of its points
  BestTriangulation best_;
};

/// The middle of a loop by length; false where it makes a triangle without area with an edge of it.
bool middleOf(const std::vector<Vec3>& points, const Loop& loop, Vec3& middle)
{
  const auto at = [&](std::size_t k) -> const Vec3&
  { return points[std::size_t(loop[k % loop.size()])]; };
  middle = Vec3::Zero();
  double length = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k)
  {
    const double edge = (at(k + 1) - at(k)).norm();
    middle += 0.5 * edge * (at(k) + at(k + 1));
    length += edge;
  }
  middle /= length;
  for (std::size_t k = 0; k < loop.size(); ++k)
  {
    if (collinear(middle, at(k), at(k + 1)))
    {
      return false;
    }
  }
  return true;
}

} // namespace

ClosedHoles closeHoles(TriangleMesh& mesh, const Progress& progress)
{
  ClosedHoles closed;
  const Loops loops(mesh.triangles);
  closed.left = loops.lost;
  Edges edges(mesh, loops.found);
  LeastArea least(mesh.points, edges);
  const double share = 1.0 / double(std::max(loops.found.size(), std::size_t(1)));
  for (std::size_t k = 0; k < loops.found.size(); ++k)
  {
    const Loop& loop = loops.found[k];
    Vec3 middle;
    if (!least.close(loop, ProgressPart(progress, share * double(k), share * double(k + 1))))
    {
      least.triangles.clear();
      if (!middleOf(mesh.points, loop, middle))
      {
        ++closed.left;
        continue;
      }
      const auto center = std::int32_t(mesh.points.size());
      mesh.points.push_back(middle);
      closed.addedFrom.push_back(loop.front());
      for (std::size_t n = 0; n < loop.size(); ++n)
      {
        least.triangles.push_back({ center, loop[n], loop[(n + 1) % loop.size()] });
      }
    }
    ++closed.holes;
    for (const Triangle& triangle : least.triangles)
    {
      mesh.triangles.push_back(triangle);
      edges.add(triangle);
    }
  }
  if (closed.holes > 0)
  {
    mesh.normals.clear();
    orientTriangles(mesh);
  }
  return closed;
}

} // namespace hybridtree
