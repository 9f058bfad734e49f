// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/stitch/CutCases.h"

#include "core/stitch/TriangleBlocks.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace hybridtree::test
{

std::vector<CutCase> cutCases()
{
  return { { "coarse sphere", icosphere(0.9, 1), 0.11 }, { "fine sphere", icosphere(0.9, 4), 0.3 },
    { "torus", torus(0.6, 0.25, 40, 20), 0.13 },
    // All of its faces in planes of the lattice, and corners on lattice points.
    { "box on the lattice", box(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)), 0.125 },
    { "box", box(Vec3(-0.51, -0.62, -0.43), Vec3(0.57, 0.51, 0.7)), 0.125 } };
}

CellSet randomCells(Random& random, int reach, double share)
{
  CellSet cells;
  for (int z = -reach; z < reach; ++z)
  {
    for (int y = -reach; y < reach; ++y)
    {
      for (int x = -reach; x < reach; ++x)
      {
        if (random.chance(share))
        {
          cells.insert({ x, y, z });
        }
      }
    }
  }
  cells.fillDiagonals();
  return cells;
}

CutMesh cutAll(const TriangleMesh& mesh, const CellSet& cells, const CellGrid& grid)
{
  return cutMesh(mesh, TriangleBlocks(mesh).near(cells.boxes(grid, 1e-6)), cells, grid);
}

std::vector<std::int32_t> keptTriangles(const TriangleMesh& mesh, const CutMesh& cut)
{
  std::vector<std::int32_t> kept;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t)
  {
    if (!std::binary_search(cut.gone.begin(), cut.gone.end(), t))
    {
      kept.push_back(t);
    }
  }
  return kept;
}

Vec3 pointOf(const TriangleMesh& mesh, const CutMesh& cut, std::int32_t v)
{
  const auto points = static_cast<std::int32_t>(mesh.points.size());
  return v < points ? mesh.points[v] : cut.vertices[v - points].point;
}

void expectNoCrack(
  const TriangleMesh& mesh, const CutMesh& cut, const CellSet& cells, const std::string& name)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  const auto add = [&](const Triangle& c)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++sides[{ c[k], c[(k + 1) % 3] }];
    }
  };
  for (const std::int32_t t : keptTriangles(mesh, cut))
  {
    add(mesh.triangles[t]);
  }
  for (const Triangle& piece : cut.pieces)
  {
    add(piece);
  }
  std::map<std::int32_t, int> ends;
  for (const BorderSegment& segment : cut.segments)
  {
    EXPECT_TRUE(cells.contains(segment.cell));
    ++sides[{ segment.from, segment.to }];
    ++ends[segment.from];
    --ends[segment.to];
  }
  for (const auto& [side, count] : sides)
  {
    ASSERT_EQ(count, 1) << name;
    const auto opposite = sides.find({ side.second, side.first });
    ASSERT_NE(opposite, sides.end()) << name;
  }
  for (const auto& [vertex, sum] : ends)
  {
    ASSERT_EQ(sum, 0) << name << " vertex " << vertex;
  }
}

} // namespace hybridtree::test
