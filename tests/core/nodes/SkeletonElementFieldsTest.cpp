// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SkeletonElementFields.h"

#include "core/mesh/MeshChecks.h"
#include "core/subdivision/PieceMeshes.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

std::shared_ptr<const SubdivisionSkeleton> leafOf(
  const SkeletonGraph& graph, KernelKind kernel, BlendingKind blending)
{
  SubdivisionSkeletonOptions options;
  options.kernel.kind = kernel;
  options.blending.kind = blending;
  return std::static_pointer_cast<const SubdivisionSkeleton>(
    makeSubdivisionSkeleton(graph, options));
}

// Wherever points are, near their element or not.
TEST(SkeletonElementFields, AreTheFieldItself)
{
  Random random(1);
  for (const BlendingKind blending :
    { BlendingKind::All, BlendingKind::Neighbours, BlendingKind::Paper })
  {
    const auto leaf = leafOf(figure7(), KernelKind::Compact, blending);
    const SkeletonElementFields fields(*leaf, SkeletonElementFields::Sums::Largest);
    for (std::int32_t element = 0; element < 12; ++element)
    {
      const std::int32_t point = leaf->coarse().segments[static_cast<std::size_t>(element) % 5][0];
      const Vec3 center = leaf->refined().points[static_cast<std::size_t>(point)];
      const double size = element < 6 ? 0.5 : 3.0;
      const PointList points = randomPoints(
        random, Box3(Vec3(center - Vec3::Constant(size)), Vec3(center + Vec3::Constant(size))), 40);
      std::vector<double> expected(points.size());
      std::vector<double> value(points.size());
      VectorList slope(points.size());
      VectorList gradient(points.size());
      leaf->fieldAndGradient(points, expected.data(), slope);
      const VectorBatch slopes = gradient;
      fields.evaluate(element, points, value.data(), &slopes);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        EXPECT_NEAR(value[k], expected[k], 1e-13);
        EXPECT_LT((gradient.batch()[k] - slope.batch()[k]).norm(), 1e-11);
      }
      fields.evaluate(element, points, value.data(), nullptr);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        EXPECT_NEAR(value[k], expected[k], 1e-13);
      }
    }
  }
}

// Where neighbours blend what a piece follows is the field.
TEST(SkeletonElementFields, PiecesByDistanceFollowTheField)
{
  for (const KernelKind kernel : { KernelKind::Compact, KernelKind::Cauchy })
  {
    const auto leaf = leafOf(bretzel(), kernel, BlendingKind::Neighbours);
    const SkeletonElementFields fields(*leaf, SkeletonElementFields::Sums::Own);
    EXPECT_FALSE(fields.areOwnSums());
    std::size_t found = 0;
    for (const PieceMeshPtr& piece :
      pieceMeshes({ leaf->coarse(), leaf->refined(), leaf->options().level, *leaf, &fields }, {}))
    {
      const PointList points(piece->points);
      std::vector<double> value(points.size());
      leaf->field(points, value.data());
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        if (piece->onSurface[k])
        {
          ASSERT_NEAR(value[k], kThreshold, 2e-7 * kThreshold);
          ++found;
        }
      }
    }
    EXPECT_GT(found, 1000u);
  }
}

// [SUB] 5: every vertex lies where the sum of its own element and the neighbours of that is T.
TEST(SkeletonElementFields, PiecesFollowTheSumsOfTheirElements)
{
  for (const KernelKind kernel : { KernelKind::Compact, KernelKind::Cauchy })
  {
    const auto leaf = leafOf(bretzel(), kernel, BlendingKind::Paper);
    const SkeletonElementFields fields(*leaf, SkeletonElementFields::Sums::Own);
    const std::vector<PieceMeshPtr> pieces =
      pieceMeshes({ leaf->coarse(), leaf->refined(), leaf->options().level, *leaf, &fields }, {});
    std::size_t found = 0;
    for (const PieceMeshPtr& piece : pieces)
    {
      TriangleMesh mesh;
      mesh.points = piece->points;
      mesh.triangles = piece->triangles;
      EXPECT_TRUE(isClosedManifold(mesh));
      for (std::size_t k = 0; k < piece->points.size(); ++k)
      {
        const Vec3& p = piece->points[k];
        double value;
        leaf->convolution().ownSum(
          piece->elements[k], { &p.x(), &p.y(), &p.z(), 1 }, &value, nullptr);
        if (piece->onSurface[k])
        {
          ASSERT_NEAR(value, kThreshold, 2e-7 * kThreshold);
          ++found;
        }
      }
    }
    EXPECT_GT(found, 1000u);
  }
}

} // namespace
} // namespace hybridtree::test
