// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

#include "core/geometry/IntervalMath.h"
#include "tests/core/convolution/KernelCases.h"
#include "tests/core/convolution/Quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

ConvolutionKernel compact(int exponent, double ratio = 2.0)
{
  return { KernelKind::Compact, exponent, ratio };
}

double bump(double squaredDistance, double reach, int exponent)
{
  return std::pow(std::max(0.0, 1.0 - squaredDistance / (reach * reach)), exponent);
}

// Where a quadratic function is positive within [0, end]: outside of it there is nothing to
// integrate, and adaptive rules are fooled by narrow supports.
template <typename Quadratic>
Interval reachedPart(const Quadratic& f, double end)
{
  const double f0 = f(0.0);
  const double f1 = f(0.5 * end);
  const double f2 = f(end);
  const double square = 2.0 * (f0 - 2.0 * f1 + f2) / (end * end);
  const double linear = (f2 - f0) / end - square * end;
  const double discriminant = linear * linear - 4.0 * square * f0;
  if (square >= 0.0)
  {
    return { 0.0, end };
  }
  if (discriminant <= 0.0)
  {
    return {};
  }
  const double half = std::sqrt(discriminant);
  const Interval roots{ (-linear + half) / (2.0 * square), (-linear - half) / (2.0 * square) };
  return clamped(roots, 0.0, end);
}

TEST(CompactKernels, SegmentIsItsIntegral)
{
  Random random(1);
  int reached = 0;
  for (int round = 0; round < 400; ++round)
  {
    const SegmentCase segment = randomSegment(random, round);
    const ConvolutionKernel kernel = compact(2 + round % 7);
    const Vec3 p = pointNear(random, segment.start, segment.end, segment.startReach);
    const Interval part = reachedPart([&](double s)
      { return std::pow(segment.reach(s), 2) - (p - segment.at(s)).squaredNorm(); },
      segment.length());
    const double expected = segmentAmplitude(kernel) *
      integrate(
        [&](double s)
        {
          return segment.measure(p, s) *
            bump((p - segment.at(s)).squaredNorm(), segment.reach(s), kernel.exponent);
        },
        part.min, part.max, 1e-14);
    ASSERT_NEAR(valueAt(segment.element(), kernel, p), expected, 1e-10)
      << "round " << round << ", slope " << segment.element().slope;
    reached += expected > 1e-3;
  }
  EXPECT_GT(reached, 100);
}

TEST(CompactKernels, TriangleIsItsIntegral)
{
  Random random(2);
  int reached = 0;
  for (int round = 0; round < 150; ++round)
  {
    const TriangleCase triangle = randomTriangle(random, round);
    const ConvolutionKernel kernel = compact(2 + round % 7);
    const Vec3 p = triangle.pointNear(random, round);
    const auto inner = [&](double s, double t)
    {
      const Vec3 q = triangle.at(s, t);
      return triangle.measure(p, s, t) *
        bump((p - q).squaredNorm(), triangle.reach(s, t), kernel.exponent);
    };
    const auto line = [&](double s)
    {
      const Interval reached = reachedPart([&](double t)
        { return std::pow(triangle.reach(s, t), 2) - (p - triangle.at(s, t)).squaredNorm(); },
        1.0 - s);
      return integrate([&](double t) { return inner(s, t); }, reached.min, reached.max, 1e-13);
    };
    double expected = 0.0;
    for (int part = 0; part < 16; ++part)
    {
      expected += triangleAmplitude(kernel) * triangle.jacobian() *
        integrate(line, part / 16.0, (part + 1) / 16.0, 1e-13);
    }
    ASSERT_NEAR(valueAt(triangle.element(), kernel, p), expected, 1e-10)
      << "round " << round << ", slope " << triangle.element().slope;
    reached += expected > 1e-3;
  }
  EXPECT_GT(reached, 50);
}

TEST(CompactKernels, GradientsAreThoseOfTheField)
{
  Random random(3);
  for (int round = 0; round < 600; ++round)
  {
    const ConvolutionKernel kernel = compact(2 + round % 7);
    const SegmentCase segment = randomSegment(random, round);
    expectGradient(segment.element(), kernel,
      pointNear(random, segment.start, segment.end, segment.startReach), segment.startReach);
    const TriangleCase triangle = randomTriangle(random, round);
    expectGradient(
      triangle.element(), kernel, triangle.pointNear(random, round), triangle.reaches[0]);
  }
}

TEST(CompactKernels, LongStraightCurvesAndWideSheetsHaveTheirRadius)
{
  for (int exponent = 2; exponent <= kMaxKernelExponent; ++exponent)
  {
    for (const double radius : { 0.01, 1.0, 300.0 })
    {
      const ConvolutionKernel kernel = compact(exponent, 1.7);
      const double reach = radius * kernel.influenceRatio;
      const double far = 10.0 * reach;
      const SegmentElement line =
        makeSegmentElement(Vec3(-far, 0, 0), Vec3(far, 0, 0), reach, reach);
      EXPECT_NEAR(
        valueAt(line, kernel, Vec3(0.3 * reach, 0.6 * radius, 0.8 * radius)), kThreshold, 1e-12);
      const TriangleElement sheet =
        makeTriangleElement({ Vec3(-far, -far, 0), Vec3(far, -far, 0), Vec3(0, 2.0 * far, 0) },
          { reach, reach, reach });
      EXPECT_NEAR(valueAt(sheet, kernel, Vec3(0.3 * reach, 0.0, radius)), kThreshold, 1e-12);
      EXPECT_NEAR(valueAt(sheet, kernel, Vec3(0.3 * reach, 0.0, -radius)), kThreshold, 1e-12);
    }
  }
}

// The balls of a cone touch it where their centers see it at a right angle. Up to slopes of 1 /
// influenceRatio: beyond, the influence of all thicker balls reaches every place.
TEST(CompactKernels, LongConesAndWedgesAreTheEnvelopesOfTheirBalls)
{
  for (const double slope : { 0.05, 0.3, 0.45 })
  {
    const ConvolutionKernel kernel = compact(3);
    const auto radius = [&](double x) { return 1.0 + slope * x; };
    const double low = -0.99 / slope;
    const double high = 60.0;
    const double height = radius(0.0) / std::sqrt(1.0 - slope * slope);
    const double ratio = kernel.influenceRatio;
    const SegmentElement cone = makeSegmentElement(
      Vec3(low, 0, 0), Vec3(high, 0, 0), ratio * radius(low), ratio * radius(high));
    EXPECT_NEAR(valueAt(cone, kernel, Vec3(0, 0, height)), kThreshold, 1e-12);
    const TriangleElement wedge =
      makeTriangleElement({ Vec3(low, -500, 0), Vec3(high, 0, 0), Vec3(low, 500, 0) },
        { ratio * radius(low), ratio * radius(high), ratio * radius(low) });
    EXPECT_NEAR(valueAt(wedge, kernel, Vec3(0, 0, height)), kThreshold, 1e-12);
  }
}

TEST(CompactKernels, PartsHaveTogetherTheFieldOfTheWhole)
{
  Random random(4);
  for (int round = 0; round < 300; ++round)
  {
    const ConvolutionKernel kernel = compact(2 + round % 7);
    const SegmentCase segment = randomSegment(random, round);
    const Vec3 p = pointNear(random, segment.start, segment.end, segment.startReach);
    double sum = 0.0;
    double from = 0.0;
    while (from < segment.length())
    {
      const double to =
        std::min(segment.length(), from + random.uniform(0.05, 0.6) * segment.length());
      sum += valueAt(makeSegmentElement(
                       segment.at(from), segment.at(to), segment.reach(from), segment.reach(to)),
        kernel, p);
      from = to;
    }
    ASSERT_NEAR(sum, valueAt(segment.element(), kernel, p), 1e-10) << "round " << round;

    const TriangleCase triangle = randomTriangle(random, round);
    const Vec3 near = triangle.pointNear(random, round);
    const double s = random.uniform(0.1, 0.8);
    const double t = random.uniform(0.1, 0.9) * (1.0 - s);
    double parts = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t next = (k + 1) % 3;
      parts += valueAt(
        makeTriangleElement({ triangle.corners[k], triangle.corners[next], triangle.at(s, t) },
          { triangle.reaches[k], triangle.reaches[next], triangle.reach(s, t) }),
        kernel, near);
    }
    ASSERT_NEAR(parts, valueAt(triangle.element(), kernel, near), 1e-10) << "round " << round;
  }
}

TEST(CompactKernels, IsZeroBeyondReach)
{
  Random random(5);
  for (int round = 0; round < 2000; ++round)
  {
    const ConvolutionKernel kernel = compact(2 + round % 7);
    const TriangleCase triangle = randomTriangle(random, 0);
    const Vec3 p = triangle.at(random.uniform(0, 0.5), random.uniform(0, 0.5)) +
      random.uniform(0.5, 3.0) * triangle.reaches[0] * random.direction();
    const double distance =
      std::sqrt(nearestOnTriangle(p, triangle.corners[0], triangle.corners[1], triangle.corners[2])
                  .squaredDistance);
    if (distance > triangle.reaches[0] * (1.0 + 1e-12))
    {
      ASSERT_EQ(valueAt(triangle.element(), kernel, p), 0.0) << "round " << round;
    }
  }
}

} // namespace
} // namespace hybridtree::test
