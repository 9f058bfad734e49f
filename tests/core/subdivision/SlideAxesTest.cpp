// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SlideAxes.h"

#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace hybridtree
{
namespace
{

const test::FunctionField kBall([](const Vec3& p) { return 1.0 / (1.0 + p.squaredNorm()); });

SkeletonAxis axis(const Vec3& base, const Vec3& direction, double start = 0.5)
{
  return { base, direction, start, 0.0, 3.0, 0.5 };
}

TEST(SlideAxes, FindsTheSurfaceFromInsideAndOutside)
{
  test::Random random(3);
  std::vector<SkeletonAxis> axes;
  for (int k = 0; k < 500; ++k)
  {
    axes.push_back(
      axis(0.5 * random.unit() * random.direction(), random.direction(), random.uniform(0.0, 3.0)));
  }
  std::vector<Vec3> gradient;
  const std::vector<double> found = slideAxes(kBall, axes, &gradient);
  for (std::size_t k = 0; k < axes.size(); ++k)
  {
    const Vec3 place = axes[k].base + found[k] * axes[k].direction;
    ASSERT_NEAR(place.norm(), 1.0, 1e-6);
    EXPECT_GT(found[k], 0.0);
    EXPECT_LT((gradient[k] + 0.5 * place).norm(), 1e-6); // of 1 / (1 + r^2) at r = 1
  }
}

// What is known at the base counts as a place that was asked.
TEST(SlideAxes, AsksLessWhereTheBaseIsKnown)
{
  std::atomic<std::size_t> asked{ 0 };
  const test::FunctionField counted(
    [&](const Vec3& p)
    {
      ++asked;
      return kBall(p);
    });
  test::Random random(5);
  std::vector<SkeletonAxis> plain;
  std::vector<SkeletonAxis> known;
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 direction = random.direction();
    const double radius = random.uniform(0.8, 1.2);
    const double value = 1.0 / (1.0 + radius * radius);
    const double slope = -2.0 * radius * value * value;
    plain.push_back(axis(radius * direction, direction, (kThreshold - value) / slope));
    plain.back().least = -1.0;
    known.push_back(plain.back());
    known.back().value = value;
    known.back().slope = slope;
  }
  const std::vector<double> expected = slideAxes(counted, plain);
  const std::size_t before = asked.exchange(0);
  const std::vector<double> found = slideAxes(counted, known);
  EXPECT_LT(static_cast<double>(asked), 0.9 * static_cast<double>(before));
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_NEAR(found[k], expected[k], 1e-6);
  }
}

TEST(SlideAxes, TellsWhereThereIsNone)
{
  const test::FunctionField full([](const Vec3&) { return 1.0; });
  const test::FunctionField empty([](const Vec3&) { return 0.0; });
  const std::vector<SkeletonAxis> axes{ axis(Vec3::Zero(), Vec3::UnitX()) };
  EXPECT_TRUE(std::isnan(slideAxes(full, axes)[0]));
  EXPECT_TRUE(std::isnan(slideAxes(empty, axes)[0]));
  EXPECT_TRUE(std::isnan(slideAxes(kBall, { axis(2.0 * Vec3::UnitX(), Vec3::UnitX()) })[0]));
}

TEST(SlideAxes, StopsAtAJump)
{
  const test::FunctionField jump([](const Vec3& p) { return p.x() < 0.7 ? 1.0 : 0.1; });
  EXPECT_NEAR(slideAxes(jump, { axis(Vec3::Zero(), Vec3::UnitX()) })[0], 0.7, 1e-9);
}

// Where another body stands behind a gap the nearer surface is found.
TEST(SlideAxes, DoesNotPassAGap)
{
  const test::FunctionField two(
    [](const Vec3& p) { return std::max(kBall(p), kBall(p - Vec3(3.0, 0.0, 0.0))); });
  EXPECT_NEAR(slideAxes(two, { axis(Vec3::Zero(), Vec3::UnitX()) })[0], 1.0, 1e-6);
}

} // namespace
} // namespace hybridtree
