// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeleton.h"

#include "core/base/Error.h"
#include "core/tree/Serialize.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{
namespace
{

// A chain of straight parts of one radius along x.
SkeletonGraph straight(int parts, double length, double radius)
{
  SkeletonGraph graph;
  for (int k = 0; k <= parts; ++k)
  {
    graph.points.emplace_back(length * k / parts, 0, 0);
    graph.radii.push_back(radius);
  }
  for (int k = 0; k < parts; ++k)
  {
    graph.segments.push_back({ k, k + 1 });
  }
  return graph;
}

SubdivisionSkeletonOptions atLevel(int level)
{
  SubdivisionSkeletonOptions options;
  options.level = level;
  return options;
}

std::vector<double> fieldAt(const Node& node, const PointList& points)
{
  std::vector<double> value(points.size());
  node.field(points, value.data());
  return value;
}

// [SUB] Figure 2: no bulges where parts meet, whatever their number and the level.
TEST(SubdivisionSkeleton, SplittingAStraightSkeletonChangesNothing)
{
  Random random(1);
  const NodePtr whole = makeSubdivisionSkeleton(straight(1, 3.0, 0.4), atLevel(0));
  const PointList points = randomPoints(random, whole->influenceBounds(), 500);
  const std::vector<double> expected = fieldAt(*whole, points);
  for (const int parts : { 2, 3, 7 })
  {
    for (const int level : { 0, 1, 3 })
    {
      const std::vector<double> value =
        fieldAt(*makeSubdivisionSkeleton(straight(parts, 3.0, 0.4), atLevel(level)), points);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        ASSERT_NEAR(value[k], expected[k], 1e-9) << parts << " parts, level " << level;
      }
    }
  }
}

TEST(SubdivisionSkeleton, SurfaceBoundsAreTight)
{
  const NodePtr node = makeSubdivisionSkeleton(straight(2, 4.0, 0.5), atLevel(1));
  const Box3 bounds = node->surfaceBounds();
  const double slack = 0.02 * node->influenceBounds().sizes().maxCoeff();
  for (const int axis : { 1, 2 })
  {
    EXPECT_GE(bounds.max()[axis], 0.5 - 1e-9);
    EXPECT_LE(bounds.max()[axis], 0.5 + slack);
    EXPECT_LE(bounds.min()[axis], -0.5 + 1e-9);
    EXPECT_GE(bounds.min()[axis], -0.5 - slack);
  }
}

// What elementsReaching() leaves out does not change the field in the box.
TEST(SubdivisionSkeleton, ElementsThatReachABoxMakeItsField)
{
  Random random(2);
  const NodePtr node = makeSubdivisionSkeleton(straight(8, 6.0, 0.3), atLevel(2));
  const auto& skeleton = dynamic_cast<const SubdivisionSkeleton&>(*node);
  const Vec3 center(2.0, 0.2, 0.1);
  const Box3 box(Vec3(center - Vec3::Constant(0.2)), Vec3(center + Vec3::Constant(0.2)));
  const SubdivisionSkeleton::Reaching reaching = skeleton.elementsReaching(box);
  EXPECT_LT(reaching.segments.size(), skeleton.refined().segments.size() / 2);
  SkeletonGraph part = skeleton.refined();
  part.segments.clear();
  for (const std::size_t index : reaching.segments)
  {
    part.segments.push_back(skeleton.refined().segments[index]);
  }
  const PointList points = randomPoints(random, box, 200);
  const std::vector<double> expected = fieldAt(*node, points);
  const std::vector<double> value = fieldAt(*makeSubdivisionSkeleton(part, atLevel(0)), points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_NEAR(value[k], expected[k], 1e-12);
  }
}

TEST(SubdivisionSkeleton, RefusesWhatHasNoMeaning)
{
  const SkeletonGraph graph = straight(2, 1.0, 0.2);
  SubdivisionSkeletonOptions options;
  options.kernel.exponent = 1;
  EXPECT_THROW(makeSubdivisionSkeleton(graph, options), InvalidParameter);
  options = {};
  options.kernel.influenceRatio = 1.0;
  EXPECT_THROW(makeSubdivisionSkeleton(graph, options), InvalidParameter);
  options = {};
  options.level = 7;
  EXPECT_THROW(makeSubdivisionSkeleton(graph, options), InvalidParameter);
  EXPECT_THROW(makeSubdivisionSkeleton({}, {}), InvalidGeometry);
  Affine3 flat = Affine3::Identity();
  flat.linear().col(0).setZero();
  EXPECT_THROW(makeSubdivisionSkeleton(graph, {}, flat), InvalidParameter);
}

TEST(SubdivisionSkeleton, RefusesTextThatIsNoGraph)
{
  const std::string text = toText(*makeSubdivisionSkeleton(straight(2, 1.0, 0.2)));
  const auto withChange = [&](const std::string& from, const std::string& to)
  {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in " << text;
    return changed.replace(at, from.size(), to);
  };
  EXPECT_NO_THROW(fromText(text));
  EXPECT_THROW(fromText(withChange("\"approximating\"", "\"other\"")), Error);
  EXPECT_THROW(fromText(withChange("\"segments\":[0,1,1,2]", "\"segments\":[0,1,1]")), Error);
  EXPECT_THROW(
    fromText(withChange("\"segments\":[0,1,1,2]", "\"segments\":[0,1,1,5000000000]")), Error);
}

} // namespace
} // namespace hybridtree::test
