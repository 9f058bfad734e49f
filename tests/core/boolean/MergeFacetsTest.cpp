// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MergeFacets.h"

#include "core/mesh/MeshChecks.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/core/boolean/NearCases.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace hybridtree
{
namespace
{

using namespace test;

// A mesh and which of its triangles are parts of one plane.
struct Body
{
  TriangleMesh mesh;
  Facets facets;
};

struct CutBody
{
  Body body;
  MeshBooleanResult result;
};

CutBody cut(MeshOperation operation, const Body& a, const Body& b, bool merges)
{
  CutBody made;
  made.result = meshBoolean(operation, MeshOperand(std::make_shared<const TriangleMesh>(a.mesh)),
    MeshOperand(std::make_shared<const TriangleMesh>(b.mesh)));
  const std::array<Facets, 2> facets = { a.facets, b.facets };
  const std::array<std::size_t, 2> triangles = { a.mesh.triangles.size(), b.mesh.triangles.size() };
  if (merges)
  {
    mergeFacets(made.result, facetsOf(made.result, facets, triangles));
  }
  made.body = { made.result.mesh, facetsOf(made.result, facets, triangles) };
  return made;
}

// An upright prism through a plate between z = 0 and 1.
TriangleMesh prism(double x, double y, double radius, int sides, double turn)
{
  TriangleMesh mesh;
  for (const double z : { -0.5, 1.5 })
  {
    for (int k = 0; k < sides; ++k)
    {
      const double angle = turn + 2.0 * std::acos(-1.0) * k / sides;
      mesh.points.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), z);
    }
  }
  for (int k = 0; k < sides; ++k)
  {
    const int next = (k + 1) % sides;
    mesh.triangles.push_back({ k, next, sides + next });
    mesh.triangles.push_back({ k, sides + next, sides + k });
    if (k > 1)
    {
      mesh.triangles.push_back({ 0, k, k - 1 });
      mesh.triangles.push_back({ sides, sides + k - 1, sides + k });
    }
  }
  return mesh;
}

Body drilled(int holes, bool merges)
{
  Random random(31);
  Body plate{ box(Vec3(0.0, 0.0, 0.0), Vec3(8.0, 5.0, 1.0)), {} };
  for (int k = 0; k < holes; ++k)
  {
    const double x = 0.6 + 0.97 * (k % 8);
    const double y = 0.6 + 0.95 * (k / 8);
    const TriangleMesh hole = prism(x, y, 0.3, 24, random.unit());
    plate = cut(MeshOperation::Difference, plate, { hole, {} }, merges).body;
  }
  return plate;
}

std::map<std::int32_t, double> areaOfFacets(const Body& body)
{
  std::map<std::int32_t, double> area;
  for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t)
  {
    area[body.facets.of[t]] += 0.5 * areaNormal(body.mesh, t).norm();
  }
  return area;
}

TEST(MergeFacets, HolesDrilledInTurnLeaveNoPointsOfOneAnother)
{
  const Body merged = drilled(40, true);
  const Body plain = drilled(40, false);
  const MeshReport report = checkMesh(merged.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.genus(), 40);
  EXPECT_NEAR(signedVolume(merged.mesh), signedVolume(plain.mesh), 1e-11);
  // Eight corners, the rims, and where the diagonal of a face or of a wall is cut.
  std::vector<std::set<std::int32_t>> around(merged.mesh.points.size());
  for (std::size_t t = 0; t < merged.mesh.triangles.size(); ++t)
  {
    for (const std::int32_t point : merged.mesh.triangles[t])
    {
      around[std::size_t(point)].insert(merged.facets.of[t]);
    }
  }
  for (const std::set<std::int32_t>& facets : around)
  {
    EXPECT_GE(facets.size(), 3u);
  }
  EXPECT_LT(merged.mesh.triangles.size(), 0.7 * double(plain.mesh.triangles.size()));
  const std::map<std::int32_t, double> expected = areaOfFacets(plain);
  const std::map<std::int32_t, double> found = areaOfFacets(merged);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [facet, area] : found)
  {
    EXPECT_NEAR(area, expected.at(facet), 1e-11) << facet;
  }
}

TEST(MergeFacets, MeshesThatAreNotPartsStayBitForBit)
{
  Random random(32);
  const Body a{ bumpySphere(1.0, 3), {} };
  const Body b{ moved(torus(0.8, 0.3, 30, 12), randomPlacement(random, 0.5)), {} };
  const CutBody merged = cut(MeshOperation::Difference, a, b, true);
  const CutBody plain = cut(MeshOperation::Difference, a, b, false);
  EXPECT_EQ(merged.body.mesh.points, plain.body.mesh.points);
  EXPECT_EQ(merged.body.mesh.triangles, plain.body.mesh.triangles);
}

// Everything that cuts make of shapes, also where they share faces.
TEST(MergeFacets, ChainsStayClosedAndKeepVolumesAndSources)
{
  Random random(33);
  const std::vector<TriangleMesh> pool = { icosphere(0.8, 2), torus(0.7, 0.25, 24, 10),
    box(Vec3(-0.5, -0.6, -0.7), Vec3(0.5, 0.6, 0.7)), bumpySphere(0.8, 3) };
  const auto any = [&]() -> const TriangleMesh&
  { return pool[std::size_t(random.integer(0, int(pool.size()) - 1))]; };
  constexpr std::array<MeshOperation, 3> operations = { MeshOperation::Union,
    MeshOperation::Intersection, MeshOperation::Difference };
  const std::vector<NearCase> cases = nearCases();
  for (int chain = 0; chain < 60; ++chain)
  {
    Body body{ any(), {} };
    for (int step = 0; step < 6; ++step)
    {
      const TriangleMesh& tool = any();
      const Body b{ chain % 2 == 0
          ? moved(tool, randomPlacement(random, 0.9))
          : cases[std::size_t(random.integer(0, 8))].make(random, pool[2], tool).b,
        {} };
      const MeshOperation operation = operations[std::size_t(random.integer(0, 2))];
      const CutBody plain = cut(operation, body, b, false);
      if (!plain.result.usable || plain.body.mesh.empty())
      {
        continue;
      }
      CutBody merged = cut(operation, body, b, true);
      const std::string where = "chain " + std::to_string(chain) + ", " + std::to_string(step);
      const MeshReport report = checkMesh(merged.body.mesh);
      ASSERT_TRUE(report.closedManifold()) << where << ": " << report.describe();
      EXPECT_EQ(report.unusedPoints, 0u);
      EXPECT_NEAR(signedVolume(merged.body.mesh), signedVolume(plain.body.mesh), 1e-7) << where;
      EXPECT_LE(merged.body.mesh.points.size(), plain.body.mesh.points.size());
      TriangleMesh facing = b.mesh;
      for (Triangle& c : facing.triangles)
      {
        std::swap(c[1], c[operation == MeshOperation::Difference ? 2 : 1]);
      }
      EXPECT_LE(foldedArea(merged.result, body.mesh, facing),
        foldedArea(plain.result, body.mesh, facing) + 1e-9)
        << where;
      for (std::size_t k = 0; k < merged.result.firstCut; ++k)
      {
        const TriangleMesh& source = k < merged.result.firstOfB ? body.mesh : b.mesh;
        ASSERT_EQ(
          merged.body.mesh.points[k], source.points[std::size_t(merged.result.sourcePoint[k])]);
      }
      body = std::move(merged.body);
    }
  }
}

} // namespace
} // namespace hybridtree
