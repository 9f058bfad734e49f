// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PointCloud.h"

#include "core/base/Error.h"
#include "tests/reconstruction/Samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

TEST(PointCloud, KeepsTheFirstOfEqualPoints)
{
  std::vector<Vec3> points = randomSphere(500, 1);
  const std::size_t different = points.size();
  for (std::size_t k = 0; k < different; k += 3)
  {
    points.push_back(points[k]);
  }
  points.push_back(points[0] + Vec3(1e-15, 0.0, 0.0)); // equal in float, not in double
  const auto kept = withoutDuplicates(points, allPoints(points));
  ASSERT_EQ(kept.size(), different + 1);
  for (std::size_t k = 0; k < different; ++k)
  {
    EXPECT_EQ(kept[k], static_cast<std::int32_t>(k));
  }
  EXPECT_EQ(kept.back(), static_cast<std::int32_t>(points.size() - 1));
}

TEST(PointCloud, DropsOutliersOnly)
{
  // Far from the origin, where float could not tell the points apart.
  std::vector<Vec3> points = randomSphere(2000, 2);
  Random random(3);
  for (int k = 0; k < 20; ++k)
  {
    points.push_back(random.uniform(2.0, 5.0) * random.direction());
  }
  for (Vec3& p : points)
  {
    p = 1e-3 * p + Vec3(1e6, -2e6, 3e6);
  }
  const auto kept = withoutOutliers(points, allPoints(points), 16, 4.0);
  EXPECT_GT(kept.size(), 1990u);
  for (const std::int32_t point : kept)
  {
    EXPECT_LT(point, 2000);
  }
}

TEST(PointCloud, ThinsToASpacing)
{
  const std::vector<Vec3> points = randomSphere(3000, 4);
  const double spacing = 0.15;
  const auto kept = thinned(points, allPoints(points), spacing);
  EXPECT_LT(kept.size(), 1500u);
  for (std::size_t a = 0; a < kept.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      ASSERT_GT((points[kept[a]] - points[kept[b]]).norm(), spacing * (1.0 - 1e-5));
    }
  }
  for (const Vec3& p : points)
  {
    double nearest = 10.0;
    for (const std::int32_t k : kept)
    {
      nearest = std::min(nearest, (points[k] - p).norm());
    }
    ASSERT_LE(nearest, spacing * (1.0 + 1e-5));
  }
  EXPECT_EQ(thinned(points, allPoints(points), 0.0), allPoints(points));
  EXPECT_EQ(thinned(points, allPoints(points), 1e30).size(), 1u);
}

// Also with a radius that makes all points neighbours of each other.
TEST(PointCloud, SmoothsNoiseAway)
{
  Random random(7);
  std::vector<Vec3> noisy = randomSphere(4000, 7);
  const auto roughness = [](const std::vector<Vec3>& points, const std::vector<std::int32_t>& of)
  {
    double sum = 0.0;
    for (const std::int32_t k : of)
    {
      sum += std::abs(points[k].norm() - 1.0);
    }
    return sum / double(of.size());
  };
  for (Vec3& p : noisy)
  {
    p *= 1.0 + random.uniform(-0.03, 0.03);
  }
  std::vector<Vec3> points = noisy;
  const std::vector<std::int32_t> all = allPoints(points);
  const std::vector<std::int32_t> kept = smooth(points, all, 0.4);
  EXPECT_LT(roughness(points, kept), 0.3 * roughness(noisy, all));
  EXPECT_GT(kept.size(), 1000u);
  std::vector<Vec3> blob = noisy;
  EXPECT_LT(smooth(blob, all, 10.0).size(), 10u);
  // Those that have no neighbours stay where they are.
  std::vector<Vec3> alone = noisy;
  EXPECT_EQ(smooth(alone, all, 1e-9), all);
  EXPECT_EQ(alone, noisy);
}

TEST(PointCloud, DensityOfASphere)
{
  const std::vector<Vec3> points = randomSphere(5000, 5);
  double sum = 0.0;
  for (const double density : surfaceDensity(points, allPoints(points), 20))
  {
    sum += 1.0 / density;
  }
  const double exact = 4.0 * std::acos(-1.0) / 5000.0;
  EXPECT_NEAR(sum / 5000.0, exact, 0.1 * exact);
}

TEST(PointCloud, ChecksItsParameters)
{
  std::vector<Vec3> points = randomSphere(50, 6);
  const auto all = allPoints(points);
  EXPECT_THROW(thinned(points, all, -1.0), InvalidParameter);
  EXPECT_THROW(thinned(points, all, std::nan("")), InvalidParameter);
  EXPECT_THROW(withoutOutliers(points, all, 0, 1.0), InvalidParameter);
  EXPECT_THROW(withoutOutliers(points, all, 5, -1.0), InvalidParameter);
  EXPECT_THROW(surfaceDensity(points, all, 0), InvalidParameter);
  points[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(thinned(points, all, 1.0), InvalidGeometry);
  EXPECT_THROW(withoutOutliers(points, all, 5, 1.0), InvalidGeometry);
  EXPECT_TRUE(thinned(points, {}, 1.0).empty());
  EXPECT_TRUE(withoutDuplicates(points, {}).empty());
  for (Vec3& p : points = randomSphere(50, 8))
  {
    p *= 1e308;
  }
  EXPECT_THROW(thinned(points, all, 1.0), InvalidGeometry);
  EXPECT_THROW(surfaceDensity(points, all, 4), InvalidGeometry);
}

} // namespace
