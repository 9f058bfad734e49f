// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CutMesh.h"
#include "tests/core/stitch/CutCases.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hybridtree::test
{
namespace
{

/// Sum over triangles of p x area vector: as a volume, by which two surfaces can be told apart.
Vec3 areaVector(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return 0.5 * (b - a).cross(c - a);
}

TEST(CutMesh, LeavesNoCrackAndNoTJunction)
{
  Random random(1);
  for (const CutCase& example : cutCases())
  {
    for (const double share : { 0.02, 0.3, 0.5, 0.9 })
    {
      const CellSet cells = randomCells(random, 9, share);
      const CutMesh cut = cutAll(example.mesh, cells, CellGrid::ofLevel(example.cellSize, 2));
      expectNoCrack(example.mesh, cut, cells, example.name);
    }
  }
}

// Triangles are taken whole where no cell is marked, and the pieces have the area of what is
// outside.
TEST(CutMesh, KeepsExactlyWhatIsOutside)
{
  Random random(2);
  for (const CutCase& example : cutCases())
  {
    const CellSet cells = randomCells(random, 9, 0.4);
    const CutMesh cut = cutAll(example.mesh, cells, CellGrid::ofLevel(example.cellSize, 2));
    const CellGrid grid = CellGrid::ofLevel(example.cellSize, 2);
    const auto isMarked = [&](const Vec3& p) { return cells.contains(grid.cellAt(p)); };
    EXPECT_TRUE(std::is_sorted(cut.gone.begin(), cut.gone.end()));
    const std::vector<std::int32_t> all = keptTriangles(example.mesh, cut);
    const std::set<std::int32_t> kept(all.begin(), all.end());
    EXPECT_EQ(kept.size() + cut.gone.size(), example.mesh.triangles.size());
    std::vector<double> outside(example.mesh.triangles.size(), 0.0);
    for (std::size_t k = 0; k < cut.pieces.size(); ++k)
    {
      const Triangle& c = cut.pieces[k];
      const Triangle& whole = example.mesh.triangles[cut.pieceOf[k]];
      const Vec3 up = areaVector(example.mesh.points[whole[0]], example.mesh.points[whole[1]],
        example.mesh.points[whole[2]]);
      const Vec3 area = areaVector(pointOf(example.mesh, cut, c[0]),
        pointOf(example.mesh, cut, c[1]), pointOf(example.mesh, cut, c[2]));
      ASSERT_GE(area.dot(up), -1e-15) << example.name;
      outside[cut.pieceOf[k]] += area.dot(up) / up.norm();
    }
    for (std::size_t t = 0; t < outside.size(); ++t)
    {
      const Triangle& c = example.mesh.triangles[t];
      const Vec3& a = example.mesh.points[c[0]];
      const Vec3 ab = example.mesh.points[c[1]] - a;
      const Vec3 ac = example.mesh.points[c[2]] - a;
      const double area = 0.5 * ab.cross(ac).norm();
      constexpr int kSamples = 400;
      int hits = 0;
      for (int n = 0; n < kSamples; ++n)
      {
        double u = random.unit();
        double v = random.unit();
        if (u + v > 1.0)
        {
          u = 1.0 - u;
          v = 1.0 - v;
        }
        hits += isMarked(a + u * ab + v * ac) ? 0 : 1;
      }
      if (kept.count(static_cast<std::int32_t>(t)) != 0)
      {
        EXPECT_EQ(outside[t], 0.0);
        EXPECT_EQ(hits, kSamples);
        continue;
      }
      // Five sigma of the samples.
      EXPECT_NEAR(outside[t] / area, double(hits) / kSamples, 5.0 * 0.5 / 20.0) << example.name;
    }
  }
}

TEST(CutMesh, WithoutCellsAllIsKept)
{
  const TriangleMesh mesh = torus(0.6, 0.25, 12, 8);
  const CutMesh cut = cutAll(mesh, {}, { 0.1, Vec3::Zero() });
  EXPECT_TRUE(
    cut.gone.empty() && cut.pieces.empty() && cut.segments.empty() && cut.vertices.empty());
}

} // namespace
} // namespace hybridtree::test
