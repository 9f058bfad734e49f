// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/Assemble.h"

#include "core/base/Parallel.h"
#include "core/stitch/KeptMesh.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

/// Which of 0 .. size - 1 stay, in runs that keep their order, and the numbers that they get.
class Selection
{
public:
  struct Run
  {
    std::size_t old;
    std::size_t number;
    std::size_t count;
  };

  /// \param gone rising, each once.
  Selection(std::size_t size, const std::vector<std::int32_t>& gone, std::size_t firstNumber)
  {
    std::size_t begin = 0;
    for (const std::int32_t g : gone)
    {
      this->addRun(begin, static_cast<std::size_t>(g), firstNumber);
      begin = static_cast<std::size_t>(g) + 1;
    }
    this->addRun(begin, size, firstNumber);
  }

  std::size_t count() const { return count_; }
  const std::vector<Run>& runs() const { return runs_; }

private:
  void addRun(std::size_t begin, std::size_t end, std::size_t firstNumber)
  {
    if (begin < end)
    {
      runs_.push_back({ begin, firstNumber + count_, end - begin });
      count_ += end - begin;
    }
  }

  std::vector<Run> runs_;
  std::size_t count_ = 0;
};

/// Appends what stays of an array.
template <typename T>
void appendKept(const std::vector<T>& from, const Selection& selection, std::vector<T>& to)
{
  for (const Selection::Run& run : selection.runs())
  {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(run.old);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(run.count));
  }
}

/// Appends an array without its beginning, or, where there is none, `count` times a value.
template <typename T>
void appendOrFill(const std::vector<T>& from, std::size_t begin, std::size_t count, const T& value,
  std::vector<T>& to)
{
  if (from.empty())
  {
    to.insert(to.end(), count, value);
  }
  else
  {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin), from.end());
  }
}

/// Each array is filled from front to back, so that its memory is touched once; several at a time.
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
    this->selectTriangles();
    this->runAll(
      { &Assembler::selectPoints, &Assembler::fillLeaves, &Assembler::fillSourceTriangles });
    this->runAll({ &Assembler::fillTriangles, &Assembler::fillOrigins, &Assembler::fillPoints,
      &Assembler::fillNormals });
    return std::move(result_);
  }

private:
  using Step = void (Assembler::*)();

  /// Each of these writes what no other one reads or writes.
  void runAll(const std::vector<Step>& steps)
  {
    parallelFor(steps.size(), 1,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t k = begin; k < end; ++k)
        {
          (this->*steps[k])();
        }
      });
  }

  static std::size_t ownPoints(const PlacedIsland& placed)
  {
    return placed.island->mesh.points.size() - placed.island->rim.size();
  }

  /// What is kept keeps its order.
  void selectTriangles()
  {
    gone_.resize(parts_.size());
    for (const PlacedIsland& placed : islands_)
    {
      const Island& island = *placed.island;
      for (std::size_t k = 0; k < placed.parts.size(); ++k)
      {
        auto& all = gone_[placed.parts[k]];
        all.insert(all.end(), island.gone[k].begin(), island.gone[k].end());
      }
      triangleCount_ += island.mesh.triangles.size();
      result_.samplePoints += island.samplePoints;
      result_.cutTriangles += island.cutTriangles;
    }
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      std::sort(gone_[p].begin(), gone_[p].end());
      triangles_.emplace_back(parts_[p].mesh->triangles.size(), gone_[p], result_.keptTriangles);
      result_.keptTriangles += triangles_.back().count();
      for (const Selection::Run& run : triangles_.back().runs())
      {
        result_.keptRuns.push_back({ p, run.old, run.count });
      }
    }
    triangleCount_ += result_.keptTriangles;
  }

  /// Points of no triangle go.
  void selectPoints()
  {
    std::vector<std::vector<std::int32_t>> used(parts_.size()); // points that islands have
    for (const PlacedIsland& placed : islands_)
    {
      const Island& island = *placed.island;
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
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      points_.emplace_back(parts_[p].mesh->points.size(), this->pointsWithout(p, gone_[p], used[p]),
        result_.keptPoints);
      result_.keptPoints += points_.back().count();
    }
    pointCount_ = result_.keptPoints;
    for (const PlacedIsland& placed : islands_)
    {
      firstPoints_.push_back(pointCount_);
      pointCount_ += ownPoints(placed);
    }
  }

  /// The points of a part that no triangle has any more.
  std::vector<std::int32_t> pointsWithout(std::size_t p, const std::vector<std::int32_t>& gone,
    const std::vector<std::int32_t>& used) const
  {
    const TriangleMesh& mesh = *parts_[p].mesh;
    const PointTriangles& triangles = KeptMesh::of(parts_[p].mesh)->pointTriangles();
    std::vector<bool> isGone(mesh.triangles.size(), false);
    for (const std::int32_t t : gone)
    {
      isGone[t] = true;
    }
    std::vector<bool> isDone(mesh.points.size(), false); // stays, or is in the list
    for (const std::int32_t v : used)
    {
      isDone[v] = true;
    }
    std::vector<std::int32_t> without = triangles.unused();
    for (const std::int32_t t : gone)
    {
      for (const std::int32_t v : mesh.triangles[t])
      {
        const std::int32_t* const of = triangles.of(v);
        if (!isDone[v] &&
          std::all_of(of, of + triangles.count(v), [&](std::int32_t n) { return isGone[n]; }))
        {
          without.push_back(v);
          isDone[v] = true;
        }
      }
    }
    std::sort(without.begin(), without.end());
    return without;
  }

  void fillPoints() { this->fillVectors(&TriangleMesh::points); }
  void fillNormals() { this->fillVectors(&TriangleMesh::normals); }

  void fillVectors(std::vector<Vec3> TriangleMesh::*array)
  {
    std::vector<Vec3>& to = result_.mesh.*array;
    to.reserve(pointCount_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      appendKept((*parts_[p].mesh).*array, points_[p], to);
    }
    for (const PlacedIsland& placed : islands_)
    {
      const std::vector<Vec3>& from = placed.island->mesh.*array;
      const auto rim = static_cast<std::ptrdiff_t>(placed.island->rim.size());
      to.insert(to.end(), from.begin() + rim, from.end());
    }
  }

  void fillOrigins()
  {
    if (!hasOrigins_)
    {
      return;
    }
    std::vector<VertexOrigin>& to = result_.mesh.vertexOrigin;
    to.reserve(pointCount_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const std::vector<VertexOrigin>& from = parts_[p].mesh->vertexOrigin;
      const std::size_t first = to.size();
      if (from.empty())
      {
        to.resize(first + points_[p].count());
        continue;
      }
      appendKept(from, points_[p], to);
      for (std::size_t k = first; k < to.size() && parts_[p].firstLeaf != 0; ++k)
      {
        to[k].leaf += to[k].leaf >= 0 ? parts_[p].firstLeaf : 0;
      }
    }
    for (const PlacedIsland& placed : islands_)
    {
      appendOrFill(placed.island->mesh.vertexOrigin, placed.island->rim.size(), ownPoints(placed),
        VertexOrigin(), to);
    }
  }

  void fillTriangles()
  {
    std::vector<Triangle>& to = result_.mesh.triangles;
    to.reserve(triangleCount_);
    std::vector<std::vector<std::int32_t>> numbers; // per part and point: of the result, or -1
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      numbers.push_back(this->numbersOf(p));
      const std::vector<std::int32_t>& number = numbers.back();
      for (const Selection::Run& run : triangles_[p].runs())
      {
        for (std::size_t t = run.old; t < run.old + run.count; ++t)
        {
          const Triangle& c = parts_[p].mesh->triangles[t];
          to.push_back({ number[c[0]], number[c[1]], number[c[2]] });
        }
      }
    }
    for (std::size_t k = 0; k < islands_.size(); ++k)
    {
      const Island& island = *islands_[k].island;
      const auto rim = static_cast<std::int32_t>(island.rim.size());
      const std::int32_t shift = static_cast<std::int32_t>(firstPoints_[k]) - rim;
      for (Triangle c : island.mesh.triangles)
      {
        for (std::int32_t& v : c)
        {
          v = v < rim ? numbers[islands_[k].parts[island.rim[v].part]][island.rim[v].point]
                      : v + shift;
        }
        to.push_back(c);
      }
    }
  }

  std::vector<std::int32_t> numbersOf(std::size_t p) const
  {
    std::vector<std::int32_t> number(parts_[p].mesh->points.size(), -1);
    for (const Selection::Run& run : points_[p].runs())
    {
      const auto begin = number.begin() + static_cast<std::ptrdiff_t>(run.old);
      std::iota(begin, begin + static_cast<std::ptrdiff_t>(run.count),
        static_cast<std::int32_t>(run.number));
    }
    return number;
  }

  void fillLeaves()
  {
    std::vector<std::int32_t>& to = result_.mesh.sourceLeaf;
    to.reserve(triangleCount_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const std::size_t first = to.size();
      const std::vector<std::int32_t>& from = parts_[p].mesh->sourceLeaf;
      if (from.empty())
      {
        to.resize(first + triangles_[p].count(), -1);
        continue;
      }
      appendKept(from, triangles_[p], to);
      for (std::size_t t = first; t < to.size(); ++t)
      {
        to[t] = to[t] < 0 ? -1 : to[t] + parts_[p].firstLeaf;
      }
    }
    for (const PlacedIsland& placed : islands_)
    {
      const std::vector<std::int32_t>& from = placed.island->mesh.sourceLeaf;
      to.insert(to.end(), from.begin(), from.end());
    }
  }

  void fillSourceTriangles()
  {
    if (!hasSourceTriangles_)
    {
      return;
    }
    std::vector<std::int32_t>& to = result_.mesh.sourceTriangle;
    to.reserve(triangleCount_);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
      const std::vector<std::int32_t>& from = parts_[p].mesh->sourceTriangle;
      if (from.empty())
      {
        to.resize(to.size() + triangles_[p].count(), -1);
        continue;
      }
      appendKept(from, triangles_[p], to);
    }
    for (const PlacedIsland& placed : islands_)
    {
      const TriangleMesh& from = placed.island->mesh;
      appendOrFill(from.sourceTriangle, 0, from.triangles.size(), -1, to);
    }
  }

  const std::vector<KeptPart>& parts_;
  const std::vector<PlacedIsland>& islands_;
  bool hasSourceTriangles_ = false;
  bool hasOrigins_ = false;
  std::vector<std::vector<std::int32_t>> gone_; ///< per part: triangles, rising
  std::vector<Selection> points_;               ///< per part
  std::vector<Selection> triangles_;            ///< per part
  std::vector<std::size_t> firstPoints_;        ///< per island: of its own ones, in the result
  std::size_t pointCount_ = 0;                  ///< of the result
  std::size_t triangleCount_ = 0;
  StitchedMesh result_;
};

} // namespace

StitchedMesh assemble(const std::vector<KeptPart>& parts, const std::vector<PlacedIsland>& islands)
{
  return Assembler(parts, islands).run();
}

} // namespace hybridtree
