// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshBoolean.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/core/boolean/NearCases.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using namespace test;

MeshOperand operandOf(const TriangleMesh& mesh)
{
  return MeshOperand(std::make_shared<const TriangleMesh>(mesh));
}

std::vector<TriangleMesh> shapes()
{
  return { icosphere(0.8, 2), torus(0.7, 0.25, 24, 10),
    box(Vec3(-0.5, -0.6, -0.7), Vec3(0.5, 0.6, 0.7)), bumpySphere(0.8, 3),
    hollowSphere(0.9, 0.6, 2) };
}

TEST(MeshBoolean, HardCasesAreClosedManifoldsOfTheRightVolume)
{
  for (const BooleanCase& hard : hardCases())
  {
    EXPECT_EQ(faultsOf(allOperations(hard.a, hard.b), hard.a, hard.b, hard.common), "")
      << hard.name;
  }
}

TEST(MeshBoolean, RandomPlacementsAreClosedManifoldsWhoseVolumesAddUp)
{
  Random random(21);
  const std::vector<TriangleMesh> pool = shapes();
  for (int round = 0; round < 150; ++round)
  {
    const TriangleMesh& a = pool[std::size_t(random.integer(0, int(pool.size()) - 1))];
    const TriangleMesh b = moved(
      pool[std::size_t(random.integer(0, int(pool.size()) - 1))], randomPlacement(random, 1.5));
    EXPECT_EQ(faultsOf(allOperations(a, b), a, b), "") << "round " << round;
  }
}

TEST(MeshBoolean, NearAndTouchingPlacementsAreClosedManifoldsWhoseVolumesAddUp)
{
  Random random(24);
  const std::vector<TriangleMesh> pool = shapes();
  for (const NearCase& near : nearCases())
  {
    for (int round = 0; round < 12; ++round)
    {
      const NearPair pair =
        near.make(random, pool[std::size_t(random.integer(0, int(pool.size()) - 1))],
          pool[std::size_t(random.integer(0, int(pool.size()) - 1))]);
      EXPECT_EQ(faultsOf(allOperations(pair.a, pair.b), pair.a, pair.b), "")
        << near.name << ", round " << round;
    }
  }
}

// What rounding has folded or made cross itself is cut again: operands that share faces with what
// they are cut from.
TEST(MeshBoolean, ResultsAreOperands)
{
  Random random(25);
  const std::vector<TriangleMesh> pool = shapes();
  for (const NearCase& near : nearCases())
  {
    for (int round = 0; round < 4; ++round)
    {
      const auto [a, b] =
        near.make(random, pool[std::size_t(random.integer(0, int(pool.size()) - 1))],
          pool[std::size_t(random.integer(0, int(pool.size()) - 1))]);
      const BooleanResults first = allOperations(a, b);
      const double both = signedVolume(first.intersect.mesh);
      const double tolerance = 1e-9 * (signedVolume(a) + signedVolume(b));
      const auto check = [&](const char* name, const TriangleMesh& left, const TriangleMesh& right,
                           MeshOperation operation, double expected)
      {
        const MeshBooleanResult result = meshBoolean(operation, operandOf(left), operandOf(right));
        const std::string where = near.name + ", round " + std::to_string(round) + ", " + name;
        EXPECT_TRUE(result.usable) << where;
        EXPECT_TRUE(checkMesh(result.mesh).closedManifold()) << where;
        EXPECT_NEAR(signedVolume(result.mesh), expected, tolerance) << where;
      };
      check("(A - B) + B", first.subtract.mesh, b, MeshOperation::Union,
        signedVolume(first.unite.mesh));
      check("(A + B) - B", first.unite.mesh, b, MeshOperation::Difference, signedVolume(a) - both);
      check("(A + B) & A", first.unite.mesh, a, MeshOperation::Intersection, signedVolume(a));
      check("(A - B) & B", first.subtract.mesh, b, MeshOperation::Intersection, 0.0);
    }
  }
}

// What is put back into the hole it has left, but for rounding, leaves no gap: the surface is that
// of the whole.
TEST(MeshBoolean, GapsOfRoundingClose)
{
  Random random(28);
  const TriangleMesh brick = box(Vec3(-0.5, -0.6, -0.7), Vec3(0.5, 0.6, 0.7));
  for (int round = 0; round < 12; ++round)
  {
    const Vec3 away = 1000.0 * random.direction();
    const Affine3 shift(Eigen::Translation3d{ away });
    const TriangleMesh a = moved(round % 2 == 0 ? brick : icosphere(0.8, 2), shift);
    const TriangleMesh b = moved(moved(brick, randomPlacement(random, 0.6)), shift);
    const BooleanResults whole = allOperations(a, b);
    const Affine3 little(Eigen::Translation3d{ 1.5e-12 * random.direction() });
    const MeshBooleanResult again = meshBoolean(
      MeshOperation::Union, operandOf(whole.subtract.mesh), operandOf(moved(b, little)));
    EXPECT_TRUE(checkMesh(again.mesh).closedManifold()) << round;
    EXPECT_NEAR(areaOf(again.mesh), areaOf(whole.unite.mesh), 1e-9) << round;
    const MeshBooleanResult empty = meshBoolean(
      MeshOperation::Intersection, operandOf(whole.subtract.mesh), operandOf(moved(b, little)));
    EXPECT_TRUE(checkMesh(empty.mesh).closedManifold()) << round;
    EXPECT_LT(areaOf(empty.mesh), 1e-9) << round;
  }
}

// Sheets that lie on each other but for rounding cross themselves.
TEST(MeshBoolean, ChainsOfResultsAndTheirOperandsStayClosed)
{
  Random random(27);
  const std::vector<TriangleMesh> pool = shapes();
  for (const NearCase& near : nearCases())
  {
    NearPair pair = near.make(random, pool[std::size_t(random.integer(0, int(pool.size()) - 1))],
      pool[std::size_t(random.integer(0, int(pool.size()) - 1))]);
    std::string name = near.name;
    for (int cut = 0; cut < 4; ++cut)
    {
      const BooleanResults results = allOperations(pair.a, pair.b);
      EXPECT_EQ(faultsOf(results, pair.a, pair.b), "") << name;
      std::string link;
      pair = nextOfChain(random, pair, results, link);
      name += "; " + link;
    }
  }
}

TEST(MeshBoolean, BoxesFlushWithEachOtherCoverNothingTwice)
{
  for (const BooleanCase& hard : hardCases())
  {
    if (hard.name.rfind("cube and box", 0) == 0)
    {
      EXPECT_LE(coveredTwice(allOperations(hard.a, hard.b), hard.a, hard.b), 1e-12) << hard.name;
    }
  }
}

TriangleMesh prism(const Vec3& base, double radius, double height, int sides)
{
  TriangleMesh mesh;
  for (int k = 0; k < sides; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / sides;
    const Vec3 rim = base + radius * Vec3(std::cos(angle), std::sin(angle), 0.0);
    mesh.points.push_back(rim);
    mesh.points.push_back(rim + Vec3(0.0, 0.0, height));
  }
  mesh.points.push_back(base);
  mesh.points.push_back(base + Vec3(0.0, 0.0, height));
  for (std::int32_t k = 0; k < sides; ++k)
  {
    const std::int32_t low = 2 * k;
    const std::int32_t next = 2 * ((k + 1) % sides);
    mesh.triangles.push_back({ low, next, next + 1 });
    mesh.triangles.push_back({ low, next + 1, low + 1 });
    mesh.triangles.push_back({ 2 * sides, next, low });
    mesh.triangles.push_back({ 2 * sides + 1, low + 1, next + 1 });
  }
  return mesh;
}

// Drills that end in the faces of a plate: the rims have doubled points, and holes were filled and
// had a lid laid over them.
TEST(MeshBoolean, HolesFlushWithAPlateGoThrough)
{
  const TriangleMesh plate = box(Vec3(0, 0, 0), Vec3(4, 2, 0.4));
  for (const int sides : { 5, 16, 32, 33 })
  {
    TriangleMesh drills;
    for (int k = 0; k < 4; ++k)
    {
      drills = joined(drills, prism(Vec3(0.6 + 0.9 * k, 1.0, 0.0), 0.28, 0.4, sides));
    }
    const BooleanResults results = allOperations(plate, drills);
    EXPECT_EQ(faultsOf(results, plate, drills, signedVolume(drills)), "") << sides << " sides";
    const double pi = std::acos(-1.0);
    const double cap = 0.5 * sides * 0.28 * 0.28 * std::sin(2.0 * pi / sides);
    const double wall = 0.4 * sides * 2.0 * 0.28 * std::sin(pi / sides);
    EXPECT_NEAR(areaOf(results.subtract.mesh), 20.8 + 4.0 * (wall - 2.0 * cap), 1e-9)
      << sides << " sides";
  }
}

// A corner of a hole lies on the diagonal or on the border of a plate's face, but for rounding.
TEST(MeshBoolean, HolesThatTouchTheBordersOfTrianglesAreCutOut)
{
  Random random(26);
  for (int round = 0; round < 60; ++round)
  {
    const TriangleMesh plate = box(Vec3(0, 0, 0), Vec3(4, 2, 0.4));
    const int sides = 4 * random.integer(1, 5);
    const double radius = random.uniform(0.1, 0.45);
    const double x = random.uniform(0.6, 3.4);
    const double y = random.chance(0.3) ? radius : 0.5 * x - radius;
    const double depth = random.chance(0.5) ? 0.0 : 0.1;
    const TriangleMesh drill =
      prism(Vec3(x, std::max(y, radius), -depth), radius, 0.4 + 2.0 * depth, sides);
    const BooleanResults results = allOperations(plate, drill);
    const std::string where = "round " + std::to_string(round);
    EXPECT_EQ(faultsOf(results, plate, drill), "") << where;
    const double pi = std::acos(-1.0);
    const double cap = 0.5 * sides * radius * radius * std::sin(2.0 * pi / sides);
    const double wall = 0.4 * sides * 2.0 * radius * std::sin(pi / sides);
    EXPECT_NEAR(areaOf(results.subtract.mesh), 20.8 + wall - 2.0 * cap, 1e-9) << where;
  }
}

TEST(MeshBoolean, SmallShapeInsideOfOneTriangleMakesAHole)
{
  const TriangleMesh cube = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  TriangleMesh balls;
  double volume = 0.0;
  for (int k = 0; k < 5; ++k)
  {
    balls = joined(balls, icosphere(0.02, 2, Vec3(0.1 + 0.1 * k, 0.05, 1.0)));
  }
  const BooleanResults results = allOperations(cube, balls);
  EXPECT_EQ(faultsOf(results, cube, balls), "");
  EXPECT_EQ(results.unite.curves.size(), 5u);
  volume = signedVolume(results.intersect.mesh);
  EXPECT_NEAR(volume, 0.5 * signedVolume(balls), 0.01 * volume);
}

TEST(MeshBoolean, SourcesNameTheTrianglesThatPartsLieIn)
{
  Random random(22);
  const TriangleMesh a = bumpySphere(1.0, 3);
  const TriangleMesh b = moved(torus(0.8, 0.3, 30, 12), randomPlacement(random, 0.5));
  const MeshBooleanResult result =
    meshBoolean(MeshOperation::Difference, operandOf(a), operandOf(b));
  ASSERT_FALSE(result.mesh.empty());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    const TriangleMesh& source = result.sourceOperand[t] == 0 ? a : b;
    const std::size_t s = std::size_t(result.sourceTriangle[t]);
    const Vec3 normal = areaNormal(source, s);
    const Vec3& origin = source.points[std::size_t(source.triangles[s][0])];
    for (const std::int32_t vertex : result.mesh.triangles[t])
    {
      EXPECT_NEAR(
        normal.normalized().dot(result.mesh.points[std::size_t(vertex)] - origin), 0.0, 1e-12);
    }
    const double along = normal.dot(areaNormal(result.mesh, t));
    EXPECT_GE(result.sourceOperand[t] == 0 ? along : -along, -1e-18);
  }
  for (std::size_t k = 0; k < result.firstCut; ++k)
  {
    const TriangleMesh& source = k < result.firstOfB ? a : b;
    EXPECT_EQ(result.mesh.points[k], source.points[std::size_t(result.sourcePoint[k])]);
  }
}

TEST(MeshBoolean, CurvesLieOnBothSurfacesAndAreClosed)
{
  const MeshBooleanResult result = meshBoolean(MeshOperation::Union, operandOf(icosphere(1.0, 4)),
    operandOf(icosphere(1.0, 4, Vec3(1.0, 0.1, 0.05))));
  ASSERT_EQ(result.curves.size(), 1u);
  EXPECT_EQ(result.curves[0].front(), result.curves[0].back());
  for (const std::int32_t k : result.curves[0])
  {
    const Vec3& p = result.mesh.points[std::size_t(k)];
    EXPECT_NEAR(p.norm(), 1.0, 0.005);
    EXPECT_NEAR((p - Vec3(1.0, 0.1, 0.05)).norm(), 1.0, 0.005);
  }
}

TEST(MeshBoolean, SameBytesForAnyNumberOfThreads)
{
  Random random(23);
  const TriangleMesh a = bumpySphere(1.0, 5);
  const TriangleMesh b = moved(a, randomPlacement(random, 0.3));
  setThreadCount(1);
  const MeshBooleanResult one = meshBoolean(MeshOperation::Union, operandOf(a), operandOf(b));
  setThreadCount(2);
  const MeshBooleanResult two = meshBoolean(MeshOperation::Union, operandOf(a), operandOf(b));
  setThreadCount(0);
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.sourceTriangle, two.sourceTriangle);
}

TEST(MeshBoolean, EmptyAndDistantOperandsAreAnswers)
{
  const TriangleMesh ball = icosphere(1.0, 2);
  const TriangleMesh far = icosphere(1.0, 2, Vec3(5, 0, 0));
  EXPECT_EQ(faultsOf(allOperations(ball, far), ball, far, 0.0), "");
  EXPECT_EQ(faultsOf(allOperations(ball, {}), ball, {}, 0.0), "");
  EXPECT_EQ(faultsOf(allOperations({}, ball), {}, ball, 0.0), "");
  EXPECT_EQ(faultsOf(allOperations({}, {}), {}, {}, 0.0), "");
}

TEST(MeshBoolean, OpenOperandIsClosedAndTold)
{
  const TriangleMesh ball = icosphere(1.0, 3);
  const TriangleMesh open = withoutTriangles(icosphere(1.0, 3, Vec3(1.0, 0.2, 0.1)), 40, 30);
  const BooleanResults results = allOperations(ball, open);
  for (const MeshBooleanResult* result : { &results.unite, &results.intersect, &results.subtract })
  {
    EXPECT_TRUE(checkMesh(result->mesh).closedManifold());
    EXPECT_TRUE(result->usable);
    ASSERT_FALSE(result->warnings.empty());
    EXPECT_NE(result->warnings.front().find("second operand is not closed"), std::string::npos);
  }
}

TEST(MeshBoolean, OperandThatCrossesItselfAtTheCutIsTold)
{
  const TriangleMesh twice = joined(icosphere(1.0, 3), icosphere(1.0, 3, Vec3(0.5, 0.1, 0.2)));
  const TriangleMesh bar = box(Vec3(-2, -0.3, -0.31), Vec3(2, 0.32, 0.33));
  const MeshBooleanResult result =
    meshBoolean(MeshOperation::Union, operandOf(bar), operandOf(twice));
  EXPECT_FALSE(result.usable);
  EXPECT_TRUE(result.mesh.empty());
  ASSERT_FALSE(result.warnings.empty());
  const std::string& warning = result.warnings.back();
  EXPECT_NE(
    warning.find("The second operand crosses itself: shells of it overlap"), std::string::npos)
    << warning;
  EXPECT_EQ(warning.find("first operand"), std::string::npos) << warning;
}

// Loose triangles across each other, whose crossings with the other operand have no order.
TEST(MeshBoolean, ASoupIsToldToCrossItself)
{
  Random random(33);
  TriangleMesh soup;
  for (std::int32_t k = 0; k < 30; ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      soup.points.push_back(Vec3(random.unit(), random.unit(), random.unit()));
    }
    soup.triangles.push_back({ 3 * k, 3 * k + 1, 3 * k + 2 });
  }
  const TriangleMesh block = box(Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.6, 0.7));
  for (const bool isFirst : { true, false })
  {
    const MeshOperand a = operandOf(isFirst ? soup : block);
    const MeshOperand b = operandOf(isFirst ? block : soup);
    std::string told;
    try
    {
      const MeshBooleanResult result = meshBoolean(MeshOperation::Union, a, b);
      EXPECT_FALSE(result.usable);
      told = result.warnings.back();
    }
    catch (const InvalidGeometry& error)
    {
      told = error.what();
    }
    const std::string name = isFirst ? "The first operand" : "The second operand";
    EXPECT_NE(told.find(name + " crosses itself"), std::string::npos) << told;
  }
}

TEST(MeshBoolean, RefusesCoordinatesBeyondArithmetic)
{
  EXPECT_THROW(operandOf(box(Vec3(0, 0, 0), Vec3(1e80, 1, 1))), InvalidGeometry);
}

TEST(MeshBoolean, StopsWhenAsked)
{
  class Stop final : public Progress
  {
  public:
    bool cancelled() const override { return true; }
  };
  const MeshOperand a = operandOf(icosphere(1.0, 3));
  const MeshOperand b = operandOf(icosphere(1.0, 3, Vec3(0.5, 0, 0)));
  EXPECT_THROW(meshBoolean(MeshOperation::Union, a, b, Stop()), Cancelled);
}

} // namespace
} // namespace hybridtree
