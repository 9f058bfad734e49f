// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/GradeCut.h"
#include "core/stitch/TriangleShape.h"
#include "tests/core/stitch/CutCases.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{
namespace
{

/// A block of cells around a point, of random size.
CellSet blockAround(const Vec3& p, const CellGrid& grid, Random& random)
{
  const Index3 middle = grid.cellAt(p);
  const int reach = random.integer(1, 4);
  CellSet cells;
  for (int z = -reach; z <= reach; ++z)
  {
    for (int y = -reach; y <= reach; ++y)
    {
      for (int x = -reach; x <= reach; ++x)
      {
        cells.insert({ middle[0] + x, middle[1] + y, middle[2] + z });
      }
    }
  }
  cells.sort();
  return cells;
}

Vec3 areaVectorOf(const TriangleMesh& mesh, const CutMesh& cut, const Triangle& c)
{
  const Vec3 a = pointOf(mesh, cut, c[0]);
  return 0.5 * (pointOf(mesh, cut, c[1]) - a).cross(pointOf(mesh, cut, c[2]) - a);
}

double areaOfPieces(const TriangleMesh& mesh, const CutMesh& cut)
{
  double sum = 0.0;
  for (const Triangle& piece : cut.pieces)
  {
    sum += areaVectorOf(mesh, cut, piece).norm();
  }
  return sum;
}

double areaOf(const TriangleMesh& mesh, const std::vector<std::int32_t>& triangles)
{
  double sum = 0.0;
  for (const std::int32_t t : triangles)
  {
    sum += 0.5 * areaNormal(mesh, static_cast<std::size_t>(t)).norm();
  }
  return sum;
}

/// Of those without very short sides, which are collapsed later.
double shareOfSlivers(const TriangleMesh& mesh, const CutMesh& cut, double shortest)
{
  const auto slivers = std::count_if(cut.pieces.begin(), cut.pieces.end(),
    [&](const Triangle& corners)
    {
      const Vec3 a = pointOf(mesh, cut, corners[0]);
      const Vec3 b = pointOf(mesh, cut, corners[1]);
      const Vec3 c = pointOf(mesh, cut, corners[2]);
      return std::min({ (b - a).norm(), (c - b).norm(), (a - c).norm() }) >= shortest &&
        shapeOf(a, b, c) > std::cos(10.0 * EIGEN_PI / 180.0);
    });
  return double(slivers) / double(std::max<std::size_t>(cut.pieces.size(), 1));
}

/// A box turned at random, of which two faces consist of needles.
TriangleMesh needleBox(Random& random)
{
  TriangleMesh mesh = box(Vec3(-0.7, -0.5, -0.4), Vec3(0.7, 0.5, 0.4));
  for (int k = 0; k < 12; ++k) // each parts one side of two triangles
  {
    const Triangle c = mesh.triangles[0];
    const auto other = std::find_if(mesh.triangles.begin() + 1, mesh.triangles.end(),
      [&](const Triangle& t)
      {
        return (t[0] == c[1] && t[1] == c[0]) || (t[1] == c[1] && t[2] == c[0]) ||
          (t[2] == c[1] && t[0] == c[0]);
      });
    const auto made = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(mesh.points[c[0]] + 0.1 * (mesh.points[c[1]] - mesh.points[c[0]]).eval());
    Triangle twin = *other;
    while (twin[0] != c[1])
    {
      std::rotate(twin.begin(), twin.begin() + 1, twin.end());
    }
    *other = { twin[0], made, twin[2] };
    mesh.triangles[0] = { made, c[1], c[2] };
    mesh.triangles.push_back({ c[0], made, c[2] });
    mesh.triangles.push_back({ made, twin[1], twin[2] });
  }
  const Mat3 turn = random.rotation();
  for (Vec3& p : mesh.points)
  {
    p = turn * p;
  }
  return mesh;
}

std::vector<CutCase> coarseCases(Random& random)
{
  std::vector<CutCase> cases = cutCases();
  for (int k = 0; k < 10; ++k)
  {
    cases.push_back({ "needles " + std::to_string(k), needleBox(random), 0.03 });
  }
  for (const char* name : { "joint.off", "anchor.off", "helmet.off" })
  {
    if (std::optional<TriangleMesh> mesh = demoMesh(name))
    {
      const double size = mesh->bounds().sizes().maxCoeff();
      cases.push_back({ name, std::move(*mesh), size / 60.0 });
    }
  }
  return cases;
}

// Cracks, areas, planes and directions, of which all but the shape stays.
TEST(GradeCut, KeepsTheSurface)
{
  Random random(4);
  for (const CutCase& example : coarseCases(random))
  {
    const TriangleMesh& mesh = example.mesh;
    const KeptMesh known(mesh);
    const CellGrid grid = CellGrid::ofLevel(example.cellSize, 2);
    const double size = mesh.bounds().sizes().maxCoeff();
    for (int trial = 0; trial < 4; ++trial)
    {
      const int seed = random.integer(0, int(mesh.triangles.size()) - 1);
      const CellSet cells =
        blockAround(mesh.points[mesh.triangles[std::size_t(seed)][0]], grid, random);
      const CutMesh plain = cutAll(mesh, cells, grid);
      CutMesh cut = plain;
      gradeCut(mesh, known, grid.cellSize, cut);
      expectNoCrack(mesh, cut, cells, example.name);
      ASSERT_TRUE(std::is_sorted(cut.gone.begin(), cut.gone.end()));
      std::vector<std::int32_t> more;
      std::set_difference(cut.gone.begin(), cut.gone.end(), plain.gone.begin(), plain.gone.end(),
        std::back_inserter(more));
      const double area = areaOfPieces(mesh, plain) + areaOf(mesh, more);
      EXPECT_NEAR(areaOfPieces(mesh, cut), area, 1e-5 * (area + size * size)) << example.name;
      EXPECT_LE(shareOfSlivers(mesh, cut, 0.0), shareOfSlivers(mesh, plain, 0.0)) << example.name;
      for (std::size_t k = 0; k < cut.pieces.size(); ++k)
      {
        const auto t = static_cast<std::size_t>(cut.pieceOf[k]);
        const Vec3 up = areaNormal(mesh, t).stableNormalized();
        EXPECT_GE(areaVectorOf(mesh, cut, cut.pieces[k]).dot(up), -1e-9 * size * size);
        for (const std::int32_t v : cut.pieces[k])
        {
          const Vec3 off = pointOf(mesh, cut, v) - mesh.points[mesh.triangles[t][0]];
          EXPECT_NEAR(up.dot(off), 0.0, 1e-5 * size) << example.name;
        }
      }
    }
  }
}

TEST(GradeCut, LeavesFewNeedlesOfFlatFaces)
{
  Random random(5);
  for (int trial = 0; trial < 10; ++trial)
  {
    const TriangleMesh mesh = needleBox(random);
    const CellGrid grid = CellGrid::ofLevel(0.03, 2);
    const CellSet cells = blockAround(mesh.points.back(), grid, random);
    const CutMesh plain = cutAll(mesh, cells, grid);
    CutMesh cut = plain;
    gradeCut(mesh, KeptMesh(mesh), grid.cellSize, cut);
    const double shortest = 0.3 * grid.cellSize;
    EXPECT_GT(shareOfSlivers(mesh, plain, shortest), 0.1);
    EXPECT_LT(shareOfSlivers(mesh, cut, shortest), 0.02);
  }
}

TEST(GradeCut, ChangesNothingOnFineMeshes)
{
  Random random(6);
  const TriangleMesh mesh = icosphere(0.9, 4);
  const CellGrid grid = CellGrid::ofLevel(0.1, 2);
  const CutMesh plain = cutAll(mesh, randomCells(random, 9, 0.3), grid);
  CutMesh cut = plain;
  gradeCut(mesh, KeptMesh(mesh), grid.cellSize, cut);
  EXPECT_EQ(cut.pieces, plain.pieces);
  EXPECT_EQ(cut.gone, plain.gone);
  EXPECT_EQ(cut.vertices.size(), plain.vertices.size());
}

} // namespace
} // namespace hybridtree::test
