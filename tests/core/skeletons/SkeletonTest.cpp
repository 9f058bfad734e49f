// SPDX-License-Identifier: BSD-3-Clause
// Distance queries of every skeleton against dense samples of it, finite differences and each
// other.
#include "core/base/Error.h"
#include "core/geometry/SkeletonKernels.h"
#include "core/skeletons/SkeletonFactory.h"
#include "tests/core/skeletons/SkeletonCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;
using test::SkeletonCase;
using test::VectorList;

double distanceToSamples(const SkeletonCase& item, const Vec3& p)
{
  double squared = std::numeric_limits<double>::infinity();
  for (const Vec3& sample : item.samples)
  {
    squared = std::min(squared, (p - sample).squaredNorm());
  }
  return std::sqrt(squared);
}

Box3 around(const Skeleton& skeleton, double reach)
{
  const Box3 box = skeleton.bounds();
  return Box3(Vec3(box.min().array() - reach), Vec3(box.max().array() + reach));
}

double distanceAt(const Skeleton& skeleton, const Vec3& p)
{
  double distance;
  skeleton.distance(PointList({ p }), &distance);
  return distance;
}

TEST(Skeleton, DistanceIsThatToTheNearestSample)
{
  Random random(1);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    // A number that leaves a tail behind whole vectors.
    const PointList points = randomPoints(random, around(*item.skeleton, 1.5), 157);
    std::vector<double> distance(points.size()), signedDistance(points.size());
    item.skeleton->distance(points, distance.data());
    item.skeleton->signedDistance(points, signedDistance.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double toSamples = distanceToSamples(item, points[k]);
      const bool inside = item.inside && item.inside(points[k]);
      EXPECT_EQ(distance[k], std::max(0.0, signedDistance[k])) << item.name;
      EXPECT_EQ(inside, signedDistance[k] < 0.0) << item.name;
      EXPECT_LE(std::abs(signedDistance[k]), toSamples + 1e-12) << item.name;
      EXPECT_GE(std::abs(signedDistance[k]), toSamples - item.cover - 1e-12) << item.name;
    }
  }
}

// Those whose distance fits into a line.
TEST(Skeleton, PlainDistancesAreExact)
{
  Random random(12);
  for (int round = 0; round < 20; ++round)
  {
    const Vec3 a = random.direction();
    const Vec3 b = a + random.uniform(0.0, 2.0) * random.direction();
    const Vec3 normal = random.direction();
    const double radius = random.uniform(0.0, 2.0);
    const Vec3 lengths(random.unit(), random.unit(), random.unit());
    const Mat3 axes = random.rotation();
    const PointSkeleton point(a);
    const SegmentSkeleton segment(a, b);
    const CircleSkeleton circle(a, normal, radius);
    const BoxSkeleton box(a, lengths, axes);
    const PointList points =
      randomPoints(random, Box3(Vec3::Constant(-3.0), Vec3::Constant(3.0)), 60);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Vec3 p = points[k] - a;
      const double along = std::clamp(p.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      const double height = normal.dot(p);
      const Vec3 beyond = ((axes.transpose() * p).cwiseAbs() - 0.5 * lengths).cwiseMax(0.0);
      const auto check = [&](const Skeleton& skeleton, double expected)
      {
        EXPECT_NEAR(distanceAt(skeleton, points[k]), expected, 1e-9 * expected + 1e-14)
          << skeleton.kind();
      };
      check(point, p.norm());
      check(segment, (p - along * (b - a)).norm());
      check(circle, std::hypot((p - height * normal).norm() - radius, height));
      check(box, beyond.norm());
    }
  }
}

TEST(Skeleton, GradientIsThatOfTheDistance)
{
  Random random(2);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    const PointList points = randomPoints(random, around(*item.skeleton, 1.0), 101);
    std::vector<double> distance(points.size()), again(points.size());
    VectorList gradient(points.size());
    item.skeleton->distance(points, distance.data());
    item.skeleton->distanceAndGradient(points, again.data(), gradient);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(again[k], distance[k], 1e-13) << item.name;
      if (distance[k] == 0.0)
      {
        EXPECT_EQ(gradient[k], Vec3(Vec3::Zero())) << item.name;
        continue;
      }
      EXPECT_NEAR(gradient[k].norm(), 1.0, 1e-12) << item.name;
      // The gradient leads back to the skeleton: a second-order remainder would show.
      const Vec3 nearest = points[k] - distance[k] * gradient[k];
      EXPECT_NEAR(distanceAt(*item.skeleton, nearest), 0.0, 1e-12) << item.name;
      if (distance[k] > 0.05)
      {
        const double h = 1e-6;
        for (int axis = 0; axis < 3; ++axis)
        {
          const Vec3 step = h * Vec3::Unit(axis);
          const double slope = (distanceAt(*item.skeleton, points[k] + step) -
                                 distanceAt(*item.skeleton, points[k] - step)) /
            (2.0 * h);
          // The circle's axis is a ridge: close to it differences straddle it.
          EXPECT_NEAR(gradient[k][axis], slope, 1e-4) << item.name << " " << points[k].transpose();
        }
      }
    }
  }
}

TEST(Skeleton, OnTheAxisOfACircleOneNearestPointIsKept)
{
  Random random(3);
  for (int round = 0; round < 20; ++round)
  {
    const double radius = random.uniform(0.1, 3.0);
    const CircleSkeleton circle(random.direction(), random.direction(), radius);
    const double height = round == 0 ? 0.0 : random.uniform(-2.0, 2.0);
    const PointList points({ circle.center() + height * circle.normal() });
    double distance;
    VectorList gradient(1), second(1);
    circle.distanceAndGradient(points, &distance, gradient);
    EXPECT_NEAR(distance, std::hypot(radius, height), 1e-12);
    EXPECT_NEAR(gradient[0].norm(), 1.0, 1e-12);
    EXPECT_NEAR(distanceAt(circle, points[0] - distance * gradient[0]), 0.0, 1e-12);
    circle.distanceAndGradient(points, &distance, second);
    EXPECT_EQ(gradient[0], second[0]);
  }
}

TEST(Skeleton, ValuesDoNotDependOnThePlaceInTheBatch)
{
  Random random(4);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    const PointList points = randomPoints(random, around(*item.skeleton, 0.5), 37);
    std::vector<double> all(points.size());
    item.skeleton->distance(points, all.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_EQ(all[k], distanceAt(*item.skeleton, points[k])) << item.name;
    }
  }
}

TEST(Skeleton, FalloffIsThatOfTheDistance)
{
  Random random(5);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    for (const int exponent : { 1, 2, 3, 4, 7, 64 })
    {
      const double radius = 1.2;
      const Falloff falloff{ random.uniform(-2.0, 2.0), 1.0 / (radius * radius), exponent };
      const PointList points = randomPoints(random, around(*item.skeleton, 1.4), 53);
      std::vector<double> distance(points.size()), sum(points.size(), 0.25);
      std::vector<double> sumToo = sum;
      std::vector<double> added(points.size(), 0.0), addedDefault(points.size(), 0.0);
      VectorList direction(points.size()), gradient(points.size()), gradientDefault(points.size());
      item.skeleton->distanceAndGradient(points, distance.data(), direction);
      item.skeleton->addFalloff(points, falloff, sum.data());
      item.skeleton->addFalloffWithGradient(points, falloff, added.data(), gradient);
      // What a skeleton without kernels of its own does.
      item.skeleton->Skeleton::addFalloff(points, falloff, sumToo.data());
      item.skeleton->Skeleton::addFalloffWithGradient(
        points, falloff, addedDefault.data(), gradientDefault);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        const double u = std::max(0.0, 1.0 - std::pow(distance[k] / radius, 2));
        const double value = falloff.amplitude * std::pow(u, exponent);
        const double slope = u > 0.0 ? -2.0 * exponent * falloff.amplitude * distance[k] /
            (radius * radius) * std::pow(u, exponent - 1)
                                     : 0.0;
        EXPECT_NEAR(sum[k], 0.25 + value, 1e-11) << item.name << " n " << exponent;
        EXPECT_NEAR(sumToo[k], 0.25 + value, 1e-11) << item.name << " n " << exponent;
        EXPECT_NEAR(added[k], value, 1e-11) << item.name << " n " << exponent;
        EXPECT_NEAR(addedDefault[k], value, 1e-11) << item.name << " n " << exponent;
        if (u > 1e-9)
        {
          EXPECT_TRUE(gradient[k].isApprox(slope * direction[k], 1e-9) ||
            (gradient[k] - slope * direction[k]).norm() < 1e-10)
            << item.name << " n " << exponent;
          EXPECT_LE((gradientDefault[k] - gradient[k]).norm(), 1e-10 * (1.0 + gradient[k].norm()));
        }
      }
    }
  }
}

TEST(Skeleton, RangeBoundsTheDistanceOverTheBox)
{
  Random random(6);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    for (int round = 0; round < 60; ++round)
    {
      const double size = std::pow(10.0, random.uniform(-6.0, 0.5));
      const Vec3 corner = random.inBox(around(*item.skeleton, 1.0));
      const Vec3 sizes = size * Vec3(random.unit(), random.unit(), random.chance(0.1) ? 0.0 : 1.0);
      const Box3 box(corner, Vec3(corner + sizes));
      const Interval range = item.skeleton->distanceRange(box);
      PointList points = randomPoints(random, box, 64);
      for (int k = 0; k < 8; ++k)
      {
        points.add(box.corner(static_cast<Box3::CornerType>(k)));
      }
      std::vector<double> distance(points.size());
      item.skeleton->distance(points, distance.data());
      const auto [least, most] = std::minmax_element(distance.begin(), distance.end());
      EXPECT_LE(range.min, *least) << item.name << " size " << size;
      EXPECT_GE(range.max, *most) << item.name << " size " << size;
      // Not wider than Lipschitz would have it: the distance changes by at most the diagonal.
      EXPECT_LE(range.max - range.min, 1.001 * sizes.norm() + 1e-12) << item.name;
    }
  }
}

TEST(Skeleton, RangeIsExactToSecondOrderWhereTheDistanceIsSmooth)
{
  Random random(7);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    for (int round = 0; round < 40; ++round)
    {
      const Vec3 center = random.inBox(around(*item.skeleton, 1.0));
      double distance;
      VectorList gradient(1);
      item.skeleton->distanceAndGradient(PointList({ center }), &distance, gradient);
      if (distance < 0.1)
      {
        continue;
      }
      const Vec3 half = 1e-4 * Vec3(random.unit(), random.unit(), random.unit());
      const Interval range =
        item.skeleton->distanceRange(Box3(Vec3(center - half), Vec3(center + half)));
      const double firstOrder = gradient[0].cwiseAbs().dot(half);
      // Height and radius of circles are bounded apart, which loses some of the first order.
      const bool hasCircle = item.name == "circle" || item.name.find("hollow") == 0;
      const double allowed =
        hasCircle || !item.sharpRange ? std::sqrt(2.0) * half.norm() : firstOrder;
      EXPECT_LE(range.max - distance, allowed + 1e-6) << item.name;
      EXPECT_LE(distance - range.min, allowed + 1e-6) << item.name;
    }
  }
}

TEST(Skeleton, BoundsHoldTheSkeletonAndTouchIt)
{
  for (const SkeletonCase& item : test::skeletonCases())
  {
    const Box3 box = item.skeleton->bounds();
    Box3 samples;
    for (const Vec3& sample : item.samples)
    {
      samples.extend(sample);
    }
    EXPECT_LE((box.min() - samples.min()).maxCoeff(), 1e-12) << item.name;
    EXPECT_LE((samples.max() - box.max()).maxCoeff(), 1e-12) << item.name;
    EXPECT_LE((samples.min() - box.min()).maxCoeff(), item.cover + 1e-12) << item.name;
    EXPECT_LE((box.max() - samples.max()).maxCoeff(), item.cover + 1e-12) << item.name;
  }
}

TEST(Skeleton, SimilaritiesScaleTheDistance)
{
  Random random(8);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    const double scale = random.uniform(0.2, 4.0);
    const Affine3 map = test::randomSimilarity(random, scale);
    const SkeletonPtr image = item.skeleton->similarityImage(map, scale);
    EXPECT_STREQ(image->kind(), item.skeleton->kind());
    const PointList points = randomPoints(random, around(*item.skeleton, 1.0), 40);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      double before, after;
      item.skeleton->signedDistance(PointList({ points[k] }), &before);
      image->signedDistance(PointList({ map * points[k] }), &after);
      EXPECT_NEAR(after, scale * before, 1e-11) << item.name;
    }
  }
}

TEST(Skeleton, ParametersMakeExactlyTheSameSkeleton)
{
  Random random(9);
  for (const SkeletonCase& item : test::skeletonCases())
  {
    // Also after maps, whose rounding leaves directions not quite of unit length.
    SkeletonPtr skeleton = item.skeleton;
    for (int round = 0; round < 5; ++round)
    {
      const Parameters parameters = skeleton->parameters();
      const SkeletonPtr again = makeSkeleton(skeleton->kind(), parameters);
      EXPECT_STREQ(again->kind(), skeleton->kind());
      EXPECT_EQ(again->parameters().entries(), parameters.entries()) << item.name;
      const PointList points = randomPoints(random, around(*skeleton, 1.0), 20);
      std::vector<double> before(points.size()), after(points.size());
      skeleton->signedDistance(points, before.data());
      again->signedDistance(points, after.data());
      EXPECT_EQ(before, after) << item.name;
      const double scale = random.uniform(0.5, 2.0);
      skeleton = skeleton->similarityImage(test::randomSimilarity(random, scale), scale);
    }
  }
}

TEST(Skeleton, ALongChainOfMapsDoesNotDriftFromTheSimilarity)
{
  Random random(10);
  SkeletonPtr skeleton =
    std::make_shared<BoxSkeleton>(Vec3(1, 2, 3), Vec3(1, 2, 0.5), random.rotation());
  for (int round = 0; round < 2000; ++round)
  {
    skeleton = skeleton->similarityImage(test::randomSimilarity(random, 1.0), 1.0);
  }
  const Mat3& rotation = static_cast<const BoxSkeleton&>(*skeleton).rotation();
  EXPECT_LE((rotation.transpose() * rotation - Mat3::Identity()).norm(), 1e-13);
}

TEST(Skeleton, BadValuesAreNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto message = [](const auto& make) -> std::string
  {
    try
    {
      make();
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  const Vec3 zero = Vec3::Zero();
  EXPECT_EQ(message([&] { PointSkeleton(Vec3(0, nan, 0)); }),
    "Center is (0 nan 0); it must be three finite numbers.");
  EXPECT_EQ(message([&] { SegmentSkeleton(Vec3(0, 0, 0), Vec3(infinite, 0, 0)); }),
    "Point2 is (inf 0 0); it must be three finite numbers.");
  EXPECT_EQ(message([&] { CircleSkeleton(zero, zero, 1.0); }),
    "Normal is (0 0 0); it must be of a length other than 0, to give a direction.");
  EXPECT_EQ(message([&] { CircleSkeleton(zero, Vec3(0, 0, 1), -1.0); }),
    "Radius is -1; it must be a finite number >= 0.");
  EXPECT_EQ(message([&] { BoxSkeleton(zero, Vec3(1, -2, 1)); }),
    "Lengths is -2; it must be a finite number >= 0.");
  EXPECT_NE(message([&] { BoxSkeleton(zero, Vec3(1, 2, 1), 2.0 * Mat3::Identity()); })
              .find("three unit columns"),
    std::string::npos);
  EXPECT_THROW(makeSkeleton("knot", {}), InvalidText);
  EXPECT_THROW(makeSkeleton("circle", {}), InvalidText);
}

TEST(Skeleton, TinyAndHugeDirectionsAreDirections)
{
  for (const double size : { 1e-300, 1e-160, 1e160, 1e300 })
  {
    const CircleSkeleton circle(Vec3(0, 0, 0), size * Vec3(1, 1, 0), 1.0);
    EXPECT_TRUE(circle.normal().isApprox(Vec3(1, 1, 0).normalized(), 1e-14)) << size;
  }
}

} // namespace
} // namespace hybridtree
