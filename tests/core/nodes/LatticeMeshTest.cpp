// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LatticeMesh.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <set>

namespace hybridtree
{
namespace
{

NodePtr ball(const Vec3& center, bool negative = false)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(1.0, 2.0, 2, negative));
}

TEST(LatticeMesh, LeavesAreKnownWhereTheyAreAlone)
{
  const NodePtr tree = makeBlend({ ball(Vec3::Zero()), ball(Vec3(2.5, 0.0, 0.0)) });
  const TriangleMesh mesh = latticeMesh(*tree, 0.1);
  const MeshReport report = checkMesh(mesh);
  ASSERT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.eulerCharacteristic, 2);
  ASSERT_EQ(mesh.sourceLeaf.size(), mesh.triangles.size());
  std::set<std::int32_t> seen;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& c = mesh.triangles[t];
    const Vec3 middle = (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]) / 3.0;
    const bool first = middle.norm() < 2.0;
    const bool second = (middle - Vec3(2.5, 0.0, 0.0)).norm() < 2.0;
    EXPECT_EQ(mesh.sourceLeaf[t], first && second ? -1 : first ? 0 : 1);
    seen.insert(mesh.sourceLeaf[t]);
  }
  EXPECT_EQ(seen.size(), 3u);
}

TEST(LatticeMesh, EdgesAreOfTheStatedLength)
{
  const double length = 0.05;
  const TriangleMesh mesh = latticeMesh(*ball(Vec3(0.3, 0.1, 0.2)), length);
  double sum = 0.0;
  for (const Triangle& c : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double edge = (mesh.points[c[k]] - mesh.points[c[(k + 1) % 3]]).norm();
      EXPECT_LE(edge, std::sqrt(3.0) * length);
      sum += edge;
    }
  }
  EXPECT_NEAR(sum / (3.0 * mesh.triangles.size()), 0.95 * length, 0.05 * length);
}

// Of a shape with creases most of the time goes into them, after all is sampled.
TEST(LatticeMesh, ProgressGoesOnToTheEnd)
{
  class Recorder final : public Progress
  {
  public:
    void report(double fraction) const override
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      fractions.insert(fraction);
    }
    mutable std::set<double> fractions{ 0.0, 1.0 };

  private:
    mutable std::mutex mutex_;
  };
  const Vec3 lengths(2.0, 1.0, 1.5);
  const NodePtr box = makePrimitive(std::make_shared<BoxSkeleton>(Vec3(0.1, 0.2, 0.3), lengths),
    Potential::bySurfaceRadius(0.0, 0.5, 2));
  const Recorder recorder;
  latticeMesh(*box, 0.03, recorder);
  double last = 0.0;
  for (const double fraction : recorder.fractions)
  {
    EXPECT_LE(fraction - last, 0.15) << "at " << last;
    last = fraction;
  }
  EXPECT_EQ(last, 1.0);
}

TEST(LatticeMesh, VerticesLieOnTheSurfaceWithExactNormals)
{
  std::vector<NodePtr> parts{ ball(Vec3(0.4, 0.2, 0.1), true) };
  for (int k = 0; k < 6; ++k)
  {
    const Vec3 from(std::cos(k), std::sin(k), 0.3 * k);
    const Vec3 to(std::cos(k + 1.0), std::sin(k + 1.0), 0.3 * k + 0.3);
    parts.push_back(makePrimitive(
      std::make_shared<SegmentSkeleton>(from, to), Potential::bySurfaceRadius(0.5, 0.8, 3)));
  }
  const NodePtr tree = makeBlend(parts);
  const double length = 0.07;
  const TriangleMesh mesh = latticeMesh(*tree, length);
  ASSERT_FALSE(mesh.empty());
  EXPECT_TRUE(isClosedManifold(mesh)) << checkMesh(mesh).describe();
  double worst = 0.0;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const Vec3& p = mesh.points[k];
    double value;
    Vec3 gradient;
    tree->fieldAndGradient(
      { &p.x(), &p.y(), &p.z(), 1 }, &value, { &gradient.x(), &gradient.y(), &gradient.z() });
    worst = std::max(worst, std::abs(value - kThreshold) / gradient.norm());
    ASSERT_NEAR((mesh.normals[k] + gradient.normalized()).norm(), 0.0, 0.01);
  }
  EXPECT_LT(worst, 2e-4 * length);
}

TEST(LatticeMesh, NegativeNodesAreEmpty)
{
  EXPECT_TRUE(latticeMesh(*ball(Vec3::Zero(), true), 0.1).empty());
  const NodePtr weak =
    makePrimitive(std::make_shared<PointSkeleton>(Vec3::Zero()), Potential(0.4, 1.0, 2));
  EXPECT_TRUE(latticeMesh(*weak, 0.1).empty());
}

TEST(LatticeMesh, RefusesBadEdgeLengths)
{
  EXPECT_THROW(latticeMesh(*ball(Vec3::Zero()), 0.0), InvalidParameter);
  EXPECT_THROW(latticeMesh(*ball(Vec3::Zero()), std::nan("")), InvalidParameter);
  EXPECT_THROW(latticeMesh(*ball(Vec3::Zero()), 1e-8), TooLarge);
}

} // namespace
} // namespace hybridtree
