// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FlatSolids.h"

#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Point.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

NodePtr box(const Vec3& lengths, double surfaceRadius)
{
  return makePrimitive(std::make_shared<BoxSkeleton>(Vec3::Zero(), lengths),
    Potential::bySurfaceRadius(surfaceRadius, 1.0, 2));
}

NodePtr asMesh(const NodePtr& node)
{
  return makeMeshNode(node->mesh(0.1), 2.0, 1.0, 2);
}

// A block with a shaft through it.
NodePtr bored(double surfaceRadius, BooleanOperation operation = BooleanOperation::Difference)
{
  return makeBoolean(
    operation, box(Vec3(2, 2, 2), surfaceRadius), box(Vec3(1, 1, 4), surfaceRadius));
}

NodePtr ball()
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(Vec3(2, 0, 0)), Potential::bySurfaceRadius(0.6, 1.4, 2));
}

TEST(FlatSolids, CutBelowABlendAreToldOf)
{
  const NodePtr blend = makeBlend({ bored(0.0), ball() }, { BlendMethod::Global, 0.5 });
  blend->mesh(0.1);
  ASSERT_EQ(blend->warnings().size(), 1u);
  EXPECT_NE(blend->warnings()[0].find("(box) of surface radius 0"), std::string::npos);
  const NodePtr local = makeLocalBlend(ball(), bored(0.0), ball());
  local->mesh(0.2);
  EXPECT_EQ(local->warnings().size(), 1u);
}

TEST(FlatSolids, AreFineWhereNothingIsCut)
{
  EXPECT_TRUE(warningsOfFlatCuts({ box(Vec3(2, 2, 2), 0.0), ball() }).empty());
  EXPECT_TRUE(warningsOfFlatCuts({ bored(0.0, BooleanOperation::Union), ball() }).empty());
  EXPECT_TRUE(warningsOfFlatCuts({ bored(0.1), ball() }).empty());
  EXPECT_EQ(warningsOfFlatCuts({ makeBlend({ bored(0.0), ball() }), ball() }).size(), 1u);
}

TEST(FlatSolids, WhatTheWarningAdvisesKeepsTheHole)
{
  const NodePtr shaft = box(Vec3(1, 1, 4), 0.0);
  const NodePtr byMesh =
    makeBoolean(BooleanOperation::Difference, asMesh(box(Vec3(2, 2, 2), 0.0)), asMesh(shaft));
  for (const NodePtr& cut : { byMesh, bored(0.1) })
  {
    const NodePtr blend = makeBlend({ cut, ball() }, { BlendMethod::Global, 0.5 });
    const MeshReport report = checkMesh(*blend->mesh(0.08));
    EXPECT_EQ(report.genus(), 1);
    EXPECT_TRUE(blend->warnings().empty());
  }
}

} // namespace
} // namespace hybridtree::test
