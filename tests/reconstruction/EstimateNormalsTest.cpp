// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/EstimateNormals.h"

#include "tests/reconstruction/Samples.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

TEST(EstimateNormals, OfASphereLookOutward)
{
  const Vec3 center(5.0, -3.0, 2.0);
  Random random(1);
  std::vector<Vec3> points(3000);
  for (Vec3& p : points)
  {
    p = center + random.direction();
  }
  const std::vector<Vec3> normals = estimateNormals(points);
  ASSERT_EQ(normals.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_GT(normals[k].dot(points[k] - center), 0.95);
  }
}

TEST(EstimateNormals, OfALandscapeLookUp)
{
  Random random(2);
  std::vector<Vec3> points(5000);
  for (Vec3& p : points)
  {
    p = { random.uniform(0.0, 4.0), random.uniform(0.0, 3.0), 0.0 };
    p.z() = 0.3 * std::sin(3.0 * p.x()) * std::cos(2.0 * p.y());
  }
  for (const Vec3& normal : estimateNormals(points))
  {
    EXPECT_GT(normal.z(), 0.5);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
  }
}

// A turn of the points turns the normals.
TEST(EstimateNormals, FollowRigidMotions)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 4000, 3);
  const Eigen::AngleAxisd turn(0.7, Vec3(1.0, 2.0, 3.0).normalized());
  std::vector<Vec3> turned;
  for (const Vec3& p : points)
  {
    turned.push_back(turn * p + Vec3(10.0, 20.0, 30.0));
  }
  const std::vector<Vec3> normals = estimateNormals(points);
  const std::vector<Vec3> others = estimateNormals(turned);
  std::size_t alike = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    alike += (turn * normals[k]).dot(others[k]) > 0.999;
  }
  EXPECT_GT(alike, points.size() * 999 / 1000); // neighbours at float's equal distances may differ
}

TEST(EstimateNormals, OfFewOrEqualPointsAreHarmless)
{
  EXPECT_TRUE(estimateNormals({}).empty());
  EXPECT_TRUE(estimateNormals(std::vector<Vec3>(12, Vec3::Zero())).empty());
  const std::vector<Vec3> normals = estimateNormals(std::vector<Vec3>(50, Vec3(1, 2, 3)));
  ASSERT_EQ(normals.size(), 50u);
  for (const Vec3& normal : normals)
  {
    EXPECT_TRUE(normal.allFinite());
  }
}

} // namespace
} // namespace hybridtree::test
