// SPDX-License-Identifier: BSD-3-Clause
// Fusing real scans, as [HT] does with segments of the Igea: a part that a box cuts out of one scan
// is blended with what a box leaves of another.
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include "core/mesh/MeshChecks.h"
#include "tests/support/TestMeshes.h"
#include "tests/support/TreeChecks.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace hybridtree::test
{
namespace
{

constexpr double kEdge = 0.02;
constexpr double kReach = 0.06; // of the scans' fields

NodePtr partOf(const TriangleMesh& scan, const Box3& box)
{
  const NodePtr leaf = makeMeshNode(std::make_shared<const TriangleMesh>(scan), 1.0, kReach, 2);
  const NodePtr cutter = makeMeshNode(
    std::make_shared<const TriangleMesh>(test::box(box.min(), box.max())), 1.0, kReach, 2);
  return makeBoolean(BooleanOperation::Intersection, leaf, cutter);
}

struct Fused
{
  NodePtr body;
  NodePtr segment;
  Vec3 joint;
};

// The bear without its head, and on its neck, pressed in a little, the upper half of an elephant.
std::optional<Fused> bearWithElephant()
{
  const std::optional<TriangleMesh> bear = demoMesh("bear.off");
  const std::optional<TriangleMesh> elephant = demoMesh("elephant.off");
  if (!bear || !elephant)
  {
    return std::nullopt;
  }
  const double neck = 0.3;
  const Vec3 far = Vec3::Constant(5.0);
  Fused fused;
  fused.body = partOf(*bear, Box3(-far, Vec3(5.0, neck, 5.0)));
  TriangleMesh moved = *elephant;
  for (Vec3& p : moved.points)
  {
    p.y() += neck - 0.04;
  }
  fused.segment = partOf(moved, Box3(Vec3(-5.0, neck - 0.04, -5.0), far));
  fused.joint = Vec3(0.0, neck, 0.0);
  return fused;
}

std::set<std::array<double, 9>> trianglesOf(const TriangleMesh& mesh)
{
  std::set<std::array<double, 9>> all;
  for (const Triangle& c : mesh.triangles)
  {
    std::array<double, 9> corners;
    for (int k = 0; k < 9; ++k)
    {
      corners[std::size_t(k)] = mesh.points[std::size_t(c[std::size_t(k / 3)])][k % 3];
    }
    all.insert(corners);
  }
  return all;
}

// How many triangles of the operands are there still, bit for bit.
std::size_t keptIn(const TriangleMesh& mesh, const Fused& fused)
{
  const auto all = trianglesOf(mesh);
  std::size_t kept = 0;
  for (const Node* operand : { fused.body.get(), fused.segment.get() })
  {
    for (const auto& corners : trianglesOf(*operand->mesh(kEdge)))
    {
      kept += all.count(corners);
    }
  }
  return kept;
}

void expectFused(const Node& node, const Fused& fused, const MeshPtr& global)
{
  const MeshPtr mesh = node.mesh(kEdge);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 1u);
  EXPECT_TRUE(node.warnings().empty());
  EXPECT_EQ(verticesOffSurface(node, *mesh, kEdge, 1e-3 * kEdge), 0u);
  const SolidCheck solid = checkSolid(node, mesh, kEdge, 20000, 1);
  EXPECT_FALSE(solid.volumeOff()) << solid.excess << " sigma " << solid.sigma;
  const std::size_t own =
    fused.body->mesh(kEdge)->triangles.size() + fused.segment->mesh(kEdge)->triangles.size();
  EXPECT_GT(keptIn(*mesh, fused), own / 2);
  const Apart apart = hausdorff(mesh, global);
  for (const FarPoints* far : { &apart.ofA, &apart.ofB })
  {
    for (const Vec3& point : far->beyond(0.5 * kEdge, 0.5 * kEdge))
    {
      EXPECT_TRUE(isThin(node, point, kEdge)) << point.transpose();
    }
  }
}

TEST(FusedScans, BlendKeepsBothScansButForTheJoint)
{
  const std::optional<Fused> fused = bearWithElephant();
  if (!fused)
  {
    GTEST_SKIP() << "libcgal-demo is not installed";
  }
  const std::vector<NodePtr> parts{ fused->body, fused->segment };
  const MeshPtr global = makeBlend(parts, { BlendMethod::Global, 1.0 })->mesh(kEdge);
  for (const BlendMethod method : { BlendMethod::NodeBased, BlendMethod::PrimitiveBased })
  {
    expectFused(*makeBlend(parts, { method, 1.0 }), *fused, global);
  }
}

TEST(FusedScans, LocalBlendLeavesTheRestUnited)
{
  const std::optional<Fused> fused = bearWithElephant();
  if (!fused)
  {
    GTEST_SKIP() << "libcgal-demo is not installed";
  }
  const NodePtr region = makePrimitive(
    std::make_shared<PointSkeleton>(fused->joint), Potential::bySurfaceRadius(0.35, 0.5, 2));
  const auto blend = [&](BlendMethod method) {
    return makeLocalBlend(fused->body, fused->segment, region, { method, 1.0 });
  };
  expectFused(*blend(BlendMethod::NodeBased), *fused, blend(BlendMethod::Global)->mesh(kEdge));
}

} // namespace
} // namespace hybridtree::test
