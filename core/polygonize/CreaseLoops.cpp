// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreaseLoops.h"

#include "core/base/Parallel.h"
#include "core/polygonize/TriangleSides.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;

class LoopFinder
{
public:
  LoopFinder(
    const TriangleMesh& mesh, std::size_t first, const Lattice& lattice, double leastCosine)
    : mesh_(mesh), first_(first), lattice_(lattice), leastCosine_(leastCosine)
  {
  }

  /// Those around the first bent triangles of their cells within [begin, end).
  std::vector<CreaseLoop> run(std::size_t begin, std::size_t end)
  {
    for (std::size_t t = begin; t < end;)
    {
      if (!this->isBent(t))
      {
        ++t;
        continue;
      }
      const Run run = this->runAround(t);
      if (run.begin >= begin || !this->isAnyBent(run.begin, begin))
      {
        this->addLoops(run);
      }
      t = run.end;
    }
    return std::move(loops_);
  }

private:
  /// All triangles in a cell.
  struct Run
  {
    Index3 cell;
    std::size_t begin;
    std::size_t end;
  };

  bool isBent(std::size_t t) const
  {
    const Triangle& c = mesh_.triangles[t];
    const Vec3& a = mesh_.normals[c[0]];
    const Vec3& b = mesh_.normals[c[1]];
    const Vec3& d = mesh_.normals[c[2]];
    return std::min({ a.dot(b), b.dot(d), d.dot(a) }) < leastCosine_;
  }

  bool isAnyBent(std::size_t begin, std::size_t end) const
  {
    bool any = false;
    for (std::size_t t = begin; t < end && !any; ++t)
    {
      any = this->isBent(t);
    }
    return any;
  }

  Index3 cellOfTriangle(std::size_t t) const
  {
    const Triangle& c = mesh_.triangles[t];
    return cellOf(lattice_, (mesh_.points[c[0]] + mesh_.points[c[1]] + mesh_.points[c[2]]) / 3.0);
  }

  Run runAround(std::size_t t) const
  {
    Run run{ this->cellOfTriangle(t), t, t + 1 };
    while (run.begin > first_ && this->cellOfTriangle(run.begin - 1) == run.cell)
    {
      --run.begin;
    }
    while (run.end < mesh_.triangles.size() && this->cellOfTriangle(run.end) == run.cell)
    {
      ++run.end;
    }
    return run;
  }

  /// Parts the triangles into polygons.
  void addLoops(const Run& run)
  {
    this->joinTriangles(run.begin, run.end);
    for (std::size_t k = run.begin; k < run.end;)
    {
      std::size_t next = k + 1;
      while (next < run.end && this->rootOf(next - run.begin) == this->rootOf(k - run.begin))
      {
        ++next;
      }
      this->addLoop(run.cell, k, next);
      k = next;
    }
  }

  void joinTriangles(std::size_t begin, std::size_t end)
  {
    parent_.resize(end - begin);
    std::iota(parent_.begin(), parent_.end(), 0);
    this->collectSides(begin, end);
    for (const TriangleSide& side : sides_.all())
    {
      if (const TriangleSide* twin = sides_.twinOf(side))
      {
        parent_[this->rootOf(side.triangle - begin)] = this->rootOf(twin->triangle - begin);
      }
    }
  }

  std::size_t rootOf(std::size_t k) const
  {
    while (parent_[k] != k)
    {
      k = parent_[k];
    }
    return k;
  }

  void collectSides(std::size_t begin, std::size_t end)
  {
    sides_.clear();
    for (std::size_t t = begin; t < end; ++t)
    {
      sides_.add(mesh_, t);
    }
    sides_.sort();
  }

  void addLoop(const Index3& cell, std::size_t begin, std::size_t end)
  {
    CreaseLoop loop{ cell, begin, end - begin, {} };
    if (this->isAnyBent(begin, end) && this->findRim(loop) && LoopFinder::isDisc(loop))
    {
      loops_.push_back(std::move(loop));
    }
  }

  /// With at most one point in its midst.
  static bool isDisc(const CreaseLoop& loop)
  {
    const std::size_t sides = loop.corners.size();
    return loop.triangleCount + 2 == sides || loop.triangleCount == sides;
  }

  /// \return false where the rim is not one closed line.
  bool findRim(CreaseLoop& loop)
  {
    this->collectSides(loop.firstTriangle, loop.firstTriangle + loop.triangleCount);
    std::vector<TriangleSide> rim; // by rising `from`, as the sides are
    std::copy_if(sides_.all().begin(), sides_.all().end(), std::back_inserter(rim),
      [&](const TriangleSide& side) { return !sides_.twinOf(side); });
    while (loop.corners.size() < rim.size())
    {
      const std::int32_t at = loop.corners.empty() ? rim.front().from : last_;
      const auto found = std::lower_bound(rim.begin(), rim.end(), at,
        [](const TriangleSide& side, std::int32_t point) { return side.from < point; });
      const bool again = !loop.corners.empty() && at == loop.corners.front();
      if (again || found == rim.end() || found->from != at)
      {
        return false;
      }
      loop.corners.push_back(at);
      last_ = found->to;
    }
    return !rim.empty() && last_ == loop.corners.front();
  }

  const TriangleMesh& mesh_;
  const std::size_t first_;
  const Lattice& lattice_;
  const double leastCosine_;
  std::vector<CreaseLoop> loops_;
  TriangleSides sides_; ///< of the triangles at hand
  std::vector<std::size_t> parent_;
  std::int32_t last_ = 0;
};

} // namespace

std::vector<CreaseLoop> findCreaseLoops(const TriangleMesh& mesh, std::size_t first,
  const Lattice& lattice, double leastCosine, const Progress& progress)
{
  const std::size_t count = mesh.triangles.size() - first;
  std::vector<std::vector<CreaseLoop>> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      LoopFinder finder(mesh, first, lattice, leastCosine);
      parts[begin / kGrain] = finder.run(first + begin, first + end);
    });
  std::vector<CreaseLoop> loops;
  for (std::vector<CreaseLoop>& part : parts)
  {
    std::move(part.begin(), part.end(), std::back_inserter(loops));
  }
  return loops;
}

Index3 cellOf(const Lattice& lattice, const Vec3& point)
{
  const Vec3 place = ((point - lattice.origin) / lattice.cellSize).array().floor();
  return { static_cast<std::int64_t>(place.x()), static_cast<std::int64_t>(place.y()),
    static_cast<std::int64_t>(place.z()) };
}

} // namespace hybridtree
