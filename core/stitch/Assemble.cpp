// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Assemble.h"

#include "core/base/Parallel.h"
#include "core/stitch/KeptMesh.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 16384;

template <typename Body>
void forEachRange(std::size_t count, Body&& body)
{
  parallelFor(count, kGrain, body);
}

/// Which of 0 .. size - 1 stay, and the number that each of them gets.
class Selection
{
public:
  /// \param gone rising, each once.
  Selection(std::size_t size, const std::vector<std::int32_t>& gone, std::size_t firstNumber)
    : first_(firstNumber)
  {
    std::size_t begin = 0;
    for (const std::int32_t g : gone)
    {
      this->addRun(begin, static_cast<std::size_t>(g));
      begin = static_cast<std::size_t>(g) + 1;
    }
    this->addRun(begin, size);
  }

  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }

  /// Calls body(old, number, count) for runs that keep their order, in parallel.
  template <typename Body>
  void forEachRun(Body&& body) const
  {
    forEachRange(count_,
      [&](std::size_t begin, std::size_t end)
      {
        auto run = std::upper_bound(runs_.begin(), runs_.end(), begin,
                     [](std::size_t at, const Run& candidate) { return at < candidate.number; }) -
          1;
        while (begin < end)
        {
          const std::size_t runEnd = run + 1 == runs_.end() ? count_ : (run + 1)->number;
          const std::size_t last = std::min(end, runEnd);
          body(run->old + (begin - run->number), first_ + begin, last - begin);
          begin = last;
          ++run;
        }
      });
  }

private:
  struct Run
  {
    std::size_t old;
    std::size_t number; ///< without that of the first
  };

  void addRun(std::size_t begin, std::size_t end)
  {
    if (begin < end)
    {
      runs_.push_back({ begin, count_ });
      count_ += end - begin;
    }
  }

  std::vector<Run> runs_;
  std::size_t first_;
  std::size_t count_ = 0;
};

class Assembler
{
public:
  Assembler(const std::vector<KeptPart>& parts, const std::vector<PlacedIsland>& islands)
    : parts_(parts), islands_(islands)
  {
    for (const KeptPart& part : parts)
    {
      hasSourceTriangles_ = hasSourceTriangles_ || !part.mesh->sourceTriangle.empty();
      hasOrigins_ = hasOrigins_ || !part.mesh->vertexOrigin.empty();
    }
  }

  StitchedMesh run()
  {
    this->select();
    this->allocate();
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      this->copyPoints(p);
      this->copyTriangles(p);
    }
    std::size_t point = result_.keptPoints;
    std::size_t triangle = result_.keptTriangles;
    for (const PlacedIsland& placed : islands_)
    {
      this->addIsland(placed, point, triangle);
      point += ownPoints(placed);
      triangle += placed.island->mesh.triangles.size();
      result_.samplePoints += placed.island->samplePoints;
      result_.cutTriangles += placed.island->cutTriangles;
    }
    return std::move(result_);
  }

private:
  static std::size_t ownPoints(const PlacedIsland& placed)
  {
    return placed.island->mesh.points.size() - placed.island->rim.size();
  }

  /// What is kept keeps its order; points of no triangle go.
  void select()
  {
    std::vector<std::vector<std::int32_t>> gone(parts_.size());
    std::vector<std::vector<std::int32_t>> used(parts_.size()); // points that islands have
    for (const PlacedIsland& placed : islands_)
    {
      const Island& island = *placed.island;
      for (std::size_t k = 0; k < placed.parts.size(); ++k)
      {
        auto& all = gone[placed.parts[k]];
        all.insert(all.end(), island.gone[k].begin(), island.gone[k].end());
      }
      for (const Triangle& triangle : island.mesh.triangles)
      {
        for (const std::int32_t v : triangle)
        {
          if (static_cast<std::size_t>(v) < island.rim.size())
          {
            used[placed.parts[island.rim[v].part]].push_back(island.rim[v].point);
          }
        }
      }
    }
    std::size_t points = 0;
    std::size_t triangles = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      std::sort(gone[p].begin(), gone[p].end());
      const TriangleMesh& mesh = *parts_[p].mesh;
      points_.emplace_back(mesh.points.size(), this->pointsWithout(p, gone[p], used[p]), points);
      triangles_.emplace_back(mesh.triangles.size(), gone[p], triangles);
      points += points_.back().count();
      triangles += triangles_.back().count();
    }
    result_.keptPoints = points;
    result_.keptTriangles = triangles;
  }

  /// The points of a part that no triangle has any more.
  std::vector<std::int32_t> pointsWithout(std::size_t p, const std::vector<std::int32_t>& gone,
    const std::vector<std::int32_t>& used) const
  {
    const TriangleMesh& mesh = *parts_[p].mesh;
    std::vector<std::int32_t> left = KeptMesh::of(parts_[p].mesh)->valence();
    for (const std::int32_t t : gone)
    {
      for (const std::int32_t v : mesh.triangles[t])
      {
        --left[v];
      }
    }
    for (const std::int32_t v : used)
    {
      ++left[v];
    }
    std::vector<std::int32_t> without;
    for (std::size_t v = 0; v < left.size(); ++v)
    {
      if (left[v] == 0)
      {
        without.push_back(static_cast<std::int32_t>(v));
      }
    }
    return without;
  }

  void allocate()
  {
    std::size_t points = result_.keptPoints;
    std::size_t triangles = result_.keptTriangles;
    for (const PlacedIsland& placed : islands_)
    {
      points += ownPoints(placed);
      triangles += placed.island->mesh.triangles.size();
    }
    TriangleMesh& mesh = result_.mesh;
    mesh.points.resize(points);
    mesh.normals.resize(points);
    mesh.vertexOrigin.resize(hasOrigins_ ? points : 0);
    mesh.triangles.resize(triangles);
    mesh.sourceLeaf.resize(triangles);
    mesh.sourceTriangle.resize(hasSourceTriangles_ ? triangles : 0, -1);
  }

  void copyPoints(std::size_t p)
  {
    const TriangleMesh& from = *parts_[p].mesh;
    TriangleMesh& to = result_.mesh;
    std::vector<std::int32_t> number(from.points.size(), -1);
    points_[p].forEachRun(
      [&](std::size_t old, std::size_t first, std::size_t count)
      {
        std::copy_n(&from.points[old], count, &to.points[first]);
        std::copy_n(&from.normals[old], count, &to.normals[first]);
        for (std::size_t k = 0; k < count; ++k)
        {
          number[old + k] = static_cast<std::int32_t>(first + k);
        }
        for (std::size_t k = 0; k < count && !from.vertexOrigin.empty(); ++k)
        {
          VertexOrigin origin = from.vertexOrigin[old + k];
          origin.leaf += origin.leaf >= 0 ? parts_[p].firstLeaf : 0;
          to.vertexOrigin[first + k] = origin;
        }
      });
    numbers_.push_back(std::move(number));
  }

  void copyTriangles(std::size_t p)
  {
    const TriangleMesh& from = *parts_[p].mesh;
    TriangleMesh& to = result_.mesh;
    const std::vector<std::int32_t>& number = numbers_[p];
    triangles_[p].forEachRun(
      [&](std::size_t old, std::size_t first, std::size_t count)
      {
        for (std::size_t k = 0; k < count; ++k)
        {
          const Triangle& c = from.triangles[old + k];
          to.triangles[first + k] = { number[c[0]], number[c[1]], number[c[2]] };
        }
        for (std::size_t k = 0; k < count; ++k)
        {
          const std::int32_t leaf = from.sourceLeaf.empty() ? -1 : from.sourceLeaf[old + k];
          to.sourceLeaf[first + k] = leaf < 0 ? -1 : leaf + parts_[p].firstLeaf;
        }
        if (!from.sourceTriangle.empty())
        {
          std::copy_n(&from.sourceTriangle[old], count, &to.sourceTriangle[first]);
        }
      });
  }

  void addIsland(const PlacedIsland& placed, std::size_t firstPoint, std::size_t firstTriangle)
  {
    const Island& island = *placed.island;
    const TriangleMesh& from = island.mesh;
    TriangleMesh& to = result_.mesh;
    const auto rim = static_cast<std::ptrdiff_t>(island.rim.size());
    const auto at = [](auto& values, std::size_t first)
    { return values.begin() + static_cast<std::ptrdiff_t>(first); };
    std::copy(from.points.begin() + rim, from.points.end(), at(to.points, firstPoint));
    std::copy(from.normals.begin() + rim, from.normals.end(), at(to.normals, firstPoint));
    if (!from.vertexOrigin.empty())
    {
      std::copy(
        from.vertexOrigin.begin() + rim, from.vertexOrigin.end(), at(to.vertexOrigin, firstPoint));
    }
    std::copy(from.sourceLeaf.begin(), from.sourceLeaf.end(), at(to.sourceLeaf, firstTriangle));
    if (!from.sourceTriangle.empty())
    {
      std::copy(from.sourceTriangle.begin(), from.sourceTriangle.end(),
        at(to.sourceTriangle, firstTriangle));
    }
    const auto shift = static_cast<std::int32_t>(firstPoint) - static_cast<std::int32_t>(rim);
    for (std::size_t t = 0; t < from.triangles.size(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t v = from.triangles[t][k];
        to.triangles[firstTriangle + t][k] =
          v < rim ? numbers_[placed.parts[island.rim[v].part]][island.rim[v].point] : v + shift;
      }
    }
  }

  const std::vector<KeptPart>& parts_;
  const std::vector<PlacedIsland>& islands_;
  bool hasSourceTriangles_ = false;
  bool hasOrigins_ = false;
  std::vector<Selection> points_;                  ///< per part
  std::vector<Selection> triangles_;               ///< per part
  std::vector<std::vector<std::int32_t>> numbers_; ///< per part and point: of the result, or -1
  StitchedMesh result_;
};

} // namespace

StitchedMesh assemble(const std::vector<KeptPart>& parts, const std::vector<PlacedIsland>& islands)
{
  return Assembler(parts, islands).run();
}

} // namespace hybridtree
