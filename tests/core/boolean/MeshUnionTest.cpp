// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshUnion.h"

#include "core/mesh/MeshChecks.h"
#include "tests/core/boolean/BooleanCases.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using namespace test;

using Operands = std::vector<std::shared_ptr<const MeshOperand>>;

std::shared_ptr<const MeshOperand> operandOf(const TriangleMesh& mesh)
{
  return std::make_shared<const MeshOperand>(std::make_shared<const TriangleMesh>(mesh));
}

TEST(MeshUnion, IsThatOfOneAfterTheOther)
{
  Random random(31);
  Operands operands;
  TriangleMesh chain;
  for (int k = 0; k < 13; ++k)
  {
    const TriangleMesh mesh =
      moved(k % 2 == 0 ? icosphere(0.5, 2) : torus(0.5, 0.2, 20, 10), randomPlacement(random, 2.0));
    operands.push_back(operandOf(mesh));
    chain = meshBoolean(MeshOperation::Union, *operandOf(chain), *operands.back()).mesh;
  }
  const MeshUnionResult result = meshUnion(operands);
  ASSERT_TRUE(result.usable);
  EXPECT_TRUE(isClosedManifold(result.mesh));
  EXPECT_NEAR(signedVolume(result.mesh), signedVolume(chain), 1e-10);
  ASSERT_EQ(result.sourceOperand.size(), result.mesh.triangles.size());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    const TriangleMesh& source = operands[std::size_t(result.sourceOperand[t])]->mesh();
    const std::size_t s = std::size_t(result.sourceTriangle[t]);
    const Vec3 normal = areaNormal(source, s).normalized();
    const Vec3& origin = source.points[std::size_t(source.triangles[s][0])];
    for (const std::int32_t vertex : result.mesh.triangles[t])
    {
      EXPECT_NEAR(normal.dot(result.mesh.points[std::size_t(vertex)] - origin), 0.0, 1e-12);
    }
  }
}

TEST(MeshUnion, BoxesInARowBecomeOne)
{
  Operands operands;
  for (int k = 0; k < 9; ++k)
  {
    operands.push_back(operandOf(box(Vec3(k, 0, 0), Vec3(k + 1, 1, 1))));
  }
  const MeshUnionResult result = meshUnion(operands);
  const MeshReport report = checkMesh(result.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 1u);
  EXPECT_NEAR(signedVolume(result.mesh), 9.0, 1e-12);
}

TEST(MeshUnion, NothingAndDistantOperandsAreAnswers)
{
  EXPECT_TRUE(meshUnion({}).mesh.empty());
  const MeshUnionResult two = meshUnion(
    { operandOf(icosphere(1.0, 1)), operandOf({}), operandOf(icosphere(1.0, 1, Vec3(9, 0, 0))) });
  EXPECT_EQ(checkMesh(two.mesh).components, 2u);
  EXPECT_EQ(two.sourceOperand.front(), 0);
  EXPECT_EQ(two.sourceOperand.back(), 2);
}

} // namespace
} // namespace hybridtree
