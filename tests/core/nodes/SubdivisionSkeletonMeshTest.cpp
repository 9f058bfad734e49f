// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeletonMesh.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/LatticeMesh.h"
#include "tests/support/MeshShape.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hybridtree
{
namespace
{

std::shared_ptr<const SubdivisionSkeleton> leafOf(const SkeletonGraph& graph,
  const SubdivisionSkeletonOptions& options = {}, const Affine3& map = Affine3::Identity())
{
  return std::static_pointer_cast<const SubdivisionSkeleton>(
    makeSubdivisionSkeleton(graph, options, map));
}

TEST(SubdivisionSkeletonMesh, OfALeafIsClosedAndNamesItsPieces)
{
  const auto leaf = leafOf(test::figure7());
  const MeshPtr mesh = leaf->mesh(0.15);
  EXPECT_TRUE(isClosedManifold(*mesh));
  EXPECT_EQ(mesh->normals.size(), mesh->points.size());
  EXPECT_EQ(std::set<std::int32_t>(mesh->sourceLeaf.begin(), mesh->sourceLeaf.end()).size(),
    static_cast<std::size_t>(leaf->leafCount()));
  EXPECT_TRUE(leaf->warnings().empty());
}

TEST(SubdivisionSkeletonMesh, RefinementIsALevelOfDetailOfItsOwn)
{
  std::size_t before = 0;
  for (const double refinement : { 0.5, 0.1, 0.02 })
  {
    SubdivisionSkeletonOptions options;
    options.refinement = refinement;
    const TriangleMesh preview = subdivisionSkeletonPreview(*leafOf(test::bretzel(), options));
    EXPECT_GT(preview.triangles.size(), before + before / 2);
    before = preview.triangles.size();
  }
  SubdivisionSkeletonOptions options;
  for (const double refinement : { 0.0, -1.0, 1.5, std::nan("") })
  {
    options.refinement = refinement;
    EXPECT_THROW(leafOf(test::bretzel(), options), InvalidParameter);
  }
}

TEST(SubdivisionSkeletonMesh, PreviewFollowsAnyAffineMap)
{
  Affine3 map = Affine3::Identity();
  map.linear() << 1.0, 0.4, 0.0, 0.0, -0.7, 0.2, 0.3, 0.0, 1.5; // mirrors
  map.translation() = Vec3(1.0, 2.0, 3.0);
  const auto leaf = leafOf(test::bretzel());
  const auto image = leafOf(test::bretzel(), {}, map);
  const TriangleMesh plain = subdivisionSkeletonPreview(*leaf);
  const TriangleMesh mapped = subdivisionSkeletonPreview(*image);
  ASSERT_EQ(mapped.points.size(), plain.points.size());
  for (std::size_t k = 0; k < plain.points.size(); ++k)
  {
    ASSERT_LT((mapped.points[k] - map * plain.points[k]).norm(), 1e-12);
  }
  EXPECT_NEAR(
    signedVolume(mapped), std::abs(map.linear().determinant()) * signedVolume(plain), 1e-9);
  // Normals point the way the field falls.
  for (std::size_t k = 0; k < mapped.points.size(); k += 17)
  {
    const Vec3 p = mapped.points[k] + 1e-4 * mapped.normals[k];
    double at = 0.0;
    double outside = 0.0;
    image->field({ &mapped.points[k].x(), &mapped.points[k].y(), &mapped.points[k].z(), 1 }, &at);
    image->field({ &p.x(), &p.y(), &p.z(), 1 }, &outside);
    EXPECT_LT(outside, at);
  }
}

// Made in the skeleton's own space, so that pieces keep their triangles: far fewer thin ones than
// the lattice makes.
TEST(SubdivisionSkeletonMesh, ImagesUnderAnyMapAreMappedAndMended)
{
  Affine3 map = Affine3::Identity();
  map.linear() << 1.3, 0.4, 0.0, 0.0, -0.7, 0.2, 0.3, 0.0, 1.1; // mirrors
  for (const SkeletonGraph& graph : { test::bretzel(), test::figure7() })
  {
    constexpr double kLength = 0.12;
    const auto leaf = leafOf(graph);
    const auto image = leafOf(graph, {}, map);
    const MeshPtr mesh = image->mesh(kLength);
    EXPECT_TRUE(isClosedManifold(*mesh));
    EXPECT_TRUE(image->warnings().empty());
    EXPECT_NEAR(signedVolume(*mesh),
      std::abs(map.linear().determinant()) * signedVolume(*leaf->mesh(kLength)),
      0.01 * signedVolume(*mesh));
    EXPECT_EQ(std::set<std::int32_t>(mesh->sourceLeaf.begin(), mesh->sourceLeaf.end()).size(),
      static_cast<std::size_t>(leaf->leafCount()));
    const test::PointList points(mesh->points);
    std::vector<double> value(points.size());
    image->field(points, value.data());
    int off = 0;
    for (const double f : value)
    {
      off += std::abs(f - kThreshold) > 1e-4;
    }
    EXPECT_LE(off, 0.001 * double(points.size()));
    const test::MeshShape shape = test::shapeOf(*mesh);
    EXPECT_LE(shape.longest, 4.0 / 3.0 * kLength * (1.0 + 1e-9));
    EXPECT_LE(shape.needles, 0.3 * test::shapeOf(latticeMesh(*image, kLength)).needles);
  }
}

TEST(SubdivisionSkeletonMesh, NegativeLeavesHaveNone)
{
  SubdivisionSkeletonOptions options;
  options.negative = true;
  const auto leaf = leafOf(test::chain(3), options);
  EXPECT_TRUE(leaf->mesh(0.1)->empty());
  EXPECT_TRUE(subdivisionSkeletonPreview(*leaf).empty());
}

TEST(SubdivisionSkeletonMesh, EveryTriangleHasAPieceNearIt)
{
  const auto leaf = leafOf(test::figure7());
  const MeshPtr mesh = leaf->mesh(0.15);
  const std::vector<std::int32_t> numbers = skeletonPieceNumbers(*leaf, *mesh);
  ASSERT_EQ(numbers.size(), mesh->triangles.size());
  EXPECT_EQ(std::set<std::int32_t>(numbers.begin(), numbers.end()),
    (std::set<std::int32_t>{ 0, 1, 2, 3, 4, 5, 6 }));
  // Away from joints the pieces of the preview say the same.
  const TriangleMesh preview = subdivisionSkeletonPreview(*leaf);
  const std::vector<std::int32_t> own = skeletonPieceNumbers(*leaf, preview);
  std::size_t same = 0;
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    same += own[t] == preview.sourceLeaf[t] ? 1 : 0;
  }
  EXPECT_GT(same, own.size() * 3 / 4);
}

} // namespace
} // namespace hybridtree
