// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/Assemble.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1 << 14;

// Where the copies of the elements of each part of an array begin; one entry more, their number.
template <class CopiesOf>
std::vector<std::size_t> copiesBefore(std::size_t count, CopiesOf&& copiesOf)
{
  std::vector<std::size_t> before((count + kGrain - 1) / kGrain + 1, 0);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t kept = 0;
      for (std::size_t k = begin; k < end; ++k)
      {
        kept += std::size_t(copiesOf(k));
      }
      before[begin / kGrain + 1] = kept;
    });
  for (std::size_t part = 1; part < before.size(); ++part)
  {
    before[part] += before[part - 1];
  }
  return before;
}

class Assembly
{
public:
  Assembly(const std::array<const MeshOperand*, 2>& operands, const std::array<Keep, 2>& keep,
    const CutCurves& curves, const MeshSides& sides, const std::array<CutFaces, 2>& faces)
    : operands_(operands), keep_(keep), curves_(curves), sides_(sides), faces_(faces)
  {
  }

  MeshBooleanResult run()
  {
    this->count();
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      this->copyPoints(mesh);
    }
    this->addCutPoints();
    std::size_t at = 0;
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      this->copyTriangles(mesh, at);
      at += trianglesBefore_[mesh].back();
      this->addParts(mesh, at);
      at += faces_[mesh].triangles.size();
    }
    for (std::vector<std::int32_t>& chain : result_.curves = chainsOf(curves_))
    {
      for (std::int32_t& point : chain)
      {
        point += std::int32_t(result_.firstCut);
      }
    }
    return std::move(result_);
  }

private:
  int copiesOfPoint(std::size_t mesh, std::size_t point) const
  {
    return std::abs(keep_[mesh].copies(sides_.winding[mesh][point]));
  }

  int copiesOfTriangle(std::size_t mesh, std::size_t t) const
  {
    return (sides_.cut[mesh][t] & MeshSides::kCut) == 0
      ? this->copiesOfPoint(mesh, std::size_t(operands_[mesh]->mesh().triangles[t][0]))
      : 0;
  }

  void count()
  {
    std::size_t points = 0;
    std::size_t triangles = 0;
    std::array<std::size_t, 3> first{};
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      const TriangleMesh& m = operands_[mesh]->mesh();
      pointsBefore_[mesh] =
        copiesBefore(m.points.size(), [&](std::size_t k) { return this->copiesOfPoint(mesh, k); });
      trianglesBefore_[mesh] = copiesBefore(
        m.triangles.size(), [&](std::size_t k) { return this->copiesOfTriangle(mesh, k); });
      points += pointsBefore_[mesh].back();
      triangles += trianglesBefore_[mesh].back() + faces_[mesh].triangles.size();
      first[mesh + 1] = points;
    }
    result_.firstOfB = first[1];
    result_.firstCut = first[2];
    points +=
      curves_.crossings.size() + faces_[0].addedPoints.size() + faces_[1].addedPoints.size();
    if (std::max(points, triangles) > std::size_t(std::numeric_limits<std::int32_t>::max()) / 3)
    {
      throw TooLarge("The Boolean of two meshes would have " + std::to_string(triangles) +
        " triangles, more than can be numbered. Decimate the operands.");
    }
    result_.mesh.points.resize(points);
    result_.sourcePoint.resize(result_.firstCut);
    result_.mesh.triangles.resize(triangles);
    result_.sourceOperand.resize(triangles);
    result_.sourceTriangle.resize(triangles);
  }

  void copyPoints(std::size_t mesh)
  {
    const MeshOperand& operand = *operands_[mesh];
    const std::vector<Vec3>& points = operand.mesh().points;
    const std::int32_t original = std::int32_t(operand.original()->points.size());
    place_[mesh].resize(points.size());
    parallelFor(points.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        std::size_t at = (mesh == 0 ? 0 : result_.firstOfB) + pointsBefore_[mesh][begin / kGrain];
        for (std::size_t k = begin; k < end; ++k)
        {
          place_[mesh][k] = std::int32_t(at);
          for (int copy = this->copiesOfPoint(mesh, k); copy > 0; --copy)
          {
            result_.sourcePoint[at] = std::int32_t(k) < original ? std::int32_t(k) : -1;
            result_.mesh.points[at++] = points[k];
          }
        }
      });
  }

  void addCutPoints()
  {
    std::size_t at = result_.firstCut;
    result_.cutPoints.reserve(result_.mesh.points.size() - at);
    for (const Crossing& c : curves_.crossings)
    {
      result_.cutPoints.push_back(
        { c.mesh, c.low, c.high, c.parameter, c.other, { -1, -1 }, c.position });
      result_.mesh.points[at++] = c.position;
    }
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
    {
      firstAdded_[mesh] = std::int32_t(at);
      for (const Vec3& point : faces_[mesh].addedPoints)
      {
        CutPoint origin;
        origin.operand = std::int8_t(1 - mesh);
        origin.position = point;
        result_.cutPoints.push_back(origin);
        result_.mesh.points[at++] = point;
      }
    }
  }

  // Triangles that close an open operand come after its own.
  std::int32_t sourceOf(std::size_t mesh, std::int32_t triangle) const
  {
    return std::size_t(triangle) < operands_[mesh]->original()->triangles.size() ? triangle : -1;
  }

  void copyTriangles(std::size_t mesh, std::size_t first)
  {
    const std::vector<Triangle>& triangles = operands_[mesh]->mesh().triangles;
    const std::vector<std::int32_t>& place = place_[mesh];
    parallelFor(triangles.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        std::size_t at = first + trianglesBefore_[mesh][begin / kGrain];
        for (std::size_t t = begin; t < end; ++t)
        {
          const Triangle& c = triangles[t];
          const int copies = this->copiesOfTriangle(mesh, t);
          for (int copy = 0; copy < copies; ++copy)
          {
            const bool flip =
              keep_[mesh].flip != (keep_[mesh].copies(sides_.winding[mesh][std::size_t(c[0])]) < 0);
            const std::array<std::size_t, 3> corner = { std::size_t(c[0]),
              std::size_t(c[flip ? 2 : 1]), std::size_t(c[flip ? 1 : 2]) };
            result_.mesh.triangles[at] = { place[corner[0]] + copy, place[corner[1]] + copy,
              place[corner[2]] + copy };
            result_.sourceOperand[at] = std::int8_t(mesh);
            result_.sourceTriangle[at++] = this->sourceOf(mesh, std::int32_t(t));
          }
        }
      });
  }

  void addParts(std::size_t mesh, std::size_t at)
  {
    const std::int32_t crossings = std::int32_t(curves_.crossings.size());
    const std::int32_t vertices = std::int32_t(place_[mesh].size());
    const auto pointOf = [&](std::int32_t id)
    {
      const std::int32_t crossing = -1 - id;
      return id >= 0           ? place_[mesh][std::size_t(id % vertices)] + id / vertices
        : crossing < crossings ? std::int32_t(result_.firstCut) + crossing
                               : firstAdded_[mesh] + crossing - crossings;
    };
    for (std::size_t k = 0; k < faces_[mesh].triangles.size(); ++k, ++at)
    {
      const Triangle& c = faces_[mesh].triangles[k];
      const std::int32_t source = faces_[mesh].source[k];
      result_.mesh.triangles[at] = { pointOf(c[0]), pointOf(c[1]), pointOf(c[2]) };
      result_.sourceOperand[at] = std::int8_t(mesh);
      result_.sourceTriangle[at] = this->sourceOf(mesh, source);
      for (const std::int32_t id : c)
      {
        if (id >= 0)
        {
          continue;
        }
        CutPoint& point = result_.cutPoints[std::size_t(pointOf(id)) - result_.firstCut];
        if (-1 - id >= crossings)
        {
          point.triangle = source;
        }
        if (point.home[mesh] < 0)
        {
          point.home[mesh] = result_.sourceTriangle[at];
        }
      }
    }
  }

  const std::array<const MeshOperand*, 2>& operands_;
  const std::array<Keep, 2>& keep_;
  const CutCurves& curves_;
  const MeshSides& sides_;
  const std::array<CutFaces, 2>& faces_;
  std::array<std::vector<std::size_t>, 2> pointsBefore_;
  std::array<std::vector<std::size_t>, 2> trianglesBefore_;
  std::array<std::vector<std::int32_t>, 2> place_;
  std::array<std::int32_t, 2> firstAdded_{};
  MeshBooleanResult result_;
};

} // namespace

MeshBooleanResult assemble(const std::array<const MeshOperand*, 2>& operands,
  const std::array<Keep, 2>& keep, const CutCurves& curves, const MeshSides& sides,
  const std::array<CutFaces, 2>& faces)
{
  return Assembly(operands, keep, curves, sides, faces).run();
}

} // namespace hybridtree
