// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include "tests/support/FeatureEdges.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

constexpr double kEdge = 0.06;
const Vec3 kHalf(0.5, 0.4, 0.45);

NodePtr brick(const Affine3& place)
{
  return makeMeshNode(std::make_shared<const TriangleMesh>(box(-kHalf, kHalf)), 1.0, 0.2, 2, place);
}

NodePtr ball(const Vec3& center, double radius)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, 2.0 * radius, 2, false));
}

double fieldAt(const Node& node, const Vec3& p)
{
  double value = 0.0;
  node.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

/// A Boolean of two boxes, and a ball at one of its rims.
struct Part
{
  Affine3 place = Affine3::Identity(); ///< of the first box
  NodePtr second;
  NodePtr boolean;
  NodePtr knob;

  Part(Random& random, BooleanOperation operation, BooleanForm form)
  {
    place.linear() = random.rotation();
    Affine3 other = Affine3::Identity();
    other.linear() = random.rotation();
    other.translation() = place.linear() * Vec3(0.4, 0.0, 0.1);
    second = brick(other);
    boolean = makeBoolean(operation, brick(place), second, form);
    knob = ball(place * Vec3(-0.5, 0.4, 0.1), 0.15);
  }

  NodePtr blended(BlendMethod method) const
  {
    return makeBlend({ boolean, knob }, { method, 1.0 });
  }

  /// Somewhere on an edge of the first box.
  Vec3 onEdge(Random& random) const
  {
    Vec3 p = random.inBox({ Vec3(-kHalf), kHalf });
    const int axis = random.integer(0, 2);
    for (const int fixed : { (axis + 1) % 3, (axis + 2) % 3 })
    {
      p[fixed] = std::copysign(kHalf[fixed], p[fixed]);
    }
    return place * p;
  }
};

class SharpBlend : public testing::TestWithParam<BlendMethod>
{
};

/// Where the ball reaches, but hardly, and beyond.
TEST_P(SharpBlend, RimsOfBooleansStay)
{
  Random random(61);
  for (int n = 0; n < 4; ++n)
  {
    const Part part(random, n % 2 == 0 ? BooleanOperation::Union : BooleanOperation::Difference,
      BooleanForm::Automatic);
    const NodePtr blend = part.blended(this->GetParam());
    const MeshPtr mesh = blend->mesh(kEdge);
    ASSERT_TRUE(isClosedManifold(*mesh)) << checkMesh(*mesh).describe();
    const std::vector<FeatureEdge> edges = featureEdges(*mesh);
    int samples = 0;
    int covered = 0;
    while (samples < 500)
    {
      const Vec3 p = part.onEdge(random);
      if (fieldAt(*part.second, p) == 0.0 && fieldAt(*part.knob, p) < 1e-4)
      {
        ++samples;
        covered += isCovered(edges, p, 0.05 * kEdge);
      }
    }
    EXPECT_GT(covered, 0.97 * samples) << n;
  }
}

/// In the whole of the blend, where the field has a crease: max and min do not round it. The ball
/// is too small to show no edges of less than 45 degrees.
TEST_P(SharpBlend, EdgesFollowTheCreaseOfTheField)
{
  Random random(67);
  int off = 0;
  int all = 0;
  for (int n = 0; n < 4; ++n)
  {
    const Part part(random, n % 2 == 0 ? BooleanOperation::Union : BooleanOperation::Intersection,
      BooleanForm::MinMax);
    const NodePtr blend = part.blended(this->GetParam());
    const MeshPtr mesh = blend->mesh(kEdge);
    ASSERT_TRUE(isClosedManifold(*mesh)) << checkMesh(*mesh).describe();
    for (const FeatureEdge& edge : featureEdges(*mesh, 45.0))
    {
      const Vec3 p = 0.5 * (edge.from + edge.to);
      Vec3 slope;
      double value = 0.0;
      blend->fieldAndGradient(
        { &p.x(), &p.y(), &p.z(), 1 }, &value, { &slope.x(), &slope.y(), &slope.z() });
      off += std::abs(value - kThreshold) > 0.05 * kEdge * slope.norm();
      ++all;
    }
  }
  EXPECT_GT(all, 100);
  EXPECT_LT(off, 0.05 * all);
}

std::string methodName(const testing::TestParamInfo<BlendMethod>& info)
{
  return info.param == BlendMethod::Global ? "Global" : "NodeBased";
}

INSTANTIATE_TEST_SUITE_P(
  Methods, SharpBlend, testing::Values(BlendMethod::Global, BlendMethod::NodeBased), methodName);

} // namespace
} // namespace hybridtree::test
