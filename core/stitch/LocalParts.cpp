// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/LocalParts.h"

#include "core/base/LargestFirst.h"
#include "core/stitch/CutZone.h"
#include "core/stitch/KeptMesh.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Indices = std::vector<std::int32_t>;

constexpr double kRounding = 1e-6; // cells, as in cutIsland()

/// Sorted, each once. \param size above all numbers.
void makeUnique(Indices& list, std::size_t size)
{
  if (size > 16 * list.size())
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return;
  }
  std::vector<char> isThere(size, 0);
  for (const std::int32_t number : list)
  {
    isThere[number] = 1;
  }
  list.clear();
  for (std::size_t number = 0; number < size; ++number)
  {
    if (isThere[number])
    {
      list.push_back(std::int32_t(number));
    }
  }
}

Indices cornersOf(const TriangleMesh& mesh, const Indices& triangles)
{
  Indices corners;
  corners.reserve(3 * triangles.size());
  for (const std::int32_t t : triangles)
  {
    corners.insert(corners.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  makeUnique(corners, mesh.points.size());
  return corners;
}

/// The triangles at some points.
Indices trianglesAt(const TriangleMesh& mesh, const PointTriangles& around, const Indices& points)
{
  Indices triangles;
  triangles.reserve(6 * points.size());
  for (const std::int32_t v : points)
  {
    triangles.insert(triangles.end(), around.of(v), around.of(v) + around.count(v));
  }
  makeUnique(triangles, mesh.triangles.size());
  return triangles;
}

std::vector<Box3> brickBoxes(const CellSet& cells, const CellGrid& grid)
{
  std::vector<Box3> boxes;
  for (const CellSet::Brick& brick : cells.bricks())
  {
    const Index3 low{ kBrickSide * brick.index[0], kBrickSide * brick.index[1],
      kBrickSide * brick.index[2] };
    boxes.push_back(grid.boxOf(low, kBrickSide, kRounding));
  }
  return boxes;
}

/// Whether the box of a triangle touches a brick of cells, which does not change with what else is
/// in the mesh.
bool touches(const Box3& box, const CellSet& cells, const CellGrid& grid)
{
  const Vec3 margin = Vec3::Constant(kRounding * grid.cellSize);
  const Index3 low = brickOf(grid.cellAt(box.min() - margin));
  const Index3 high = brickOf(grid.cellAt(box.max() + margin));
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
      {
        if (cells.find({ x, y, z }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

Indices trianglesNear(
  const TriangleMesh& mesh, const KeptMesh& known, const CellSet& cells, const CellGrid& grid)
{
  Indices near = known.blocks().near(brickBoxes(cells, grid));
  const auto isFar = [&](std::int32_t t)
  {
    Box3 box;
    for (const std::int32_t v : mesh.triangles[t])
    {
      box.extend(mesh.points[v]);
    }
    return !touches(box, cells, grid);
  };
  near.erase(std::remove_if(near.begin(), near.end(), isFar), near.end());
  return near;
}

template <typename T, typename Add>
void addSome(const std::vector<T>& values, const Indices& some, Contents& contents, Add&& add)
{
  contents.add(std::int32_t(values.empty()));
  if (!values.empty())
  {
    std::for_each(some.begin(), some.end(), [&](std::int32_t k) { add(values[k]); });
  }
}

std::int32_t placeOf(const Indices& list, std::int32_t number)
{
  return std::int32_t(std::lower_bound(list.begin(), list.end(), number) - list.begin());
}

} // namespace

LocalParts::LocalParts(
  const std::vector<KeptPart>& parts, const CellSet& cells, const CellGrid& grid)
{
  for (const KeptPart& part : parts)
  {
    parts_.push_back({ part, {}, {} });
  }
  forLargestFirst(sizesOf(parts),
    [&](std::size_t p)
    {
      Part& local = parts_[p];
      const MeshPtr& mesh = local.part.mesh;
      if (local.part.isLeaf)
      {
        return;
      }
      const std::shared_ptr<const KeptMesh> known = KeptMesh::of(mesh);
      const Indices near = trianglesNear(*mesh, *known, cells, grid);
      local.triangles = trianglesAt(*mesh, known->pointTriangles(), cornersOf(*mesh, near));
      local.points = cornersOf(*mesh, local.triangles);
    });
}

bool LocalParts::areAllOf(const IslandCut& cut, const CellGrid& grid) const
{
  for (std::size_t p = 0; p < parts_.size(); ++p)
  {
    if (parts_[p].part.isLeaf)
    {
      continue;
    }
    const TriangleMesh& mesh = *parts_[p].part.mesh;
    for (const std::int32_t t : cut.cuts[p].cutTriangles)
    {
      const Triangle& c = mesh.triangles[t];
      for (int k = 0; k < 3; ++k)
      {
        const double length = (mesh.points[c[(k + 1) % 3]] - mesh.points[c[k]]).norm();
        if (CutZone::isLarge(length, grid.cellSize))
        {
          return false;
        }
      }
    }
  }
  return true;
}

void LocalParts::describe(Contents& contents) const
{
  const auto addNumber = [&](std::int32_t number) { contents.add(number); };
  const auto addVector = [&](const Vec3& p)
  { std::for_each(p.data(), p.data() + 3, [&](double number) { contents.add(number); }); };
  for (const Part& local : parts_)
  {
    const TriangleMesh& mesh = *local.part.mesh;
    contents.add(local.part.firstLeaf);
    contents.add(std::int32_t(local.part.isLeaf));
    if (local.part.isLeaf)
    {
      continue;
    }
    contents.add(std::uint64_t(local.triangles.size()));
    Indices places(local.points.empty() ? 0 : std::size_t(local.points.back()) + 1);
    for (std::size_t k = 0; k < local.points.size(); ++k)
    {
      places[local.points[k]] = std::int32_t(k);
    }
    for (const std::int32_t t : local.triangles)
    {
      for (const std::int32_t v : mesh.triangles[t])
      {
        contents.add(places[v]);
      }
    }
    addSome(mesh.points, local.points, contents, addVector);
    addSome(mesh.normals, local.points, contents, addVector);
    addSome(mesh.sourceLeaf, local.triangles, contents, addNumber);
    addSome(mesh.sourceTriangle, local.triangles, contents, addNumber);
    addSome(mesh.vertexOrigin, local.points, contents,
      [&](const VertexOrigin& origin)
      {
        contents.add(origin.leaf);
        contents.add(origin.triangle);
        contents.add(origin.u);
        contents.add(origin.v);
      });
  }
}

Island LocalParts::toPlaces(const Island& island) const
{
  Island result = island;
  for (std::size_t p = 0; p < parts_.size(); ++p)
  {
    if (!parts_[p].part.isLeaf)
    {
      for (std::int32_t& t : result.gone[p])
      {
        t = placeOf(parts_[p].triangles, t);
      }
    }
  }
  for (PartPoint& at : result.rim)
  {
    const Part& part = parts_[at.part];
    at.point = part.part.isLeaf ? at.point : placeOf(part.points, at.point);
  }
  return result;
}

Island LocalParts::fromPlaces(const Island& island) const
{
  Island result = island;
  for (std::size_t p = 0; p < parts_.size(); ++p)
  {
    if (!parts_[p].part.isLeaf)
    {
      for (std::int32_t& t : result.gone[p])
      {
        t = parts_[p].triangles[t];
      }
    }
  }
  for (PartPoint& at : result.rim)
  {
    const Part& part = parts_[at.part];
    at.point = part.part.isLeaf ? at.point : part.points[at.point];
  }
  return result;
}

} // namespace hybridtree
