// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

#include "core/convolution/ElementBounds.h"
#include "tests/core/convolution/KernelCases.h"
#include "tests/core/convolution/Quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

const ConvolutionKernel kCauchy{ KernelKind::Cauchy, 2, 2.0 };

double bump(double squaredDistance, double reach)
{
  return std::pow(1.0 + 4.0 * squaredDistance / (reach * reach), -2.0);
}

TEST(CauchyKernels, SegmentIsItsIntegral)
{
  Random random(1);
  for (int round = 0; round < 300; ++round)
  {
    const SegmentCase segment = randomSegment(random, round);
    const Vec3 p = pointNear(random, segment.start, segment.end, 3.0 * segment.startReach);
    const double expected = segmentAmplitude(kCauchy) *
      integrate(
        [&](double s) {
          return segment.measure(p, s) * bump((p - segment.at(s)).squaredNorm(), segment.reach(s));
        },
        0.0, segment.length(), 1e-14);
    ASSERT_NEAR(valueAt(segment.element(), kCauchy, p), expected, 1e-10)
      << "round " << round << ", slope " << segment.element().slope;
  }
}

TEST(CauchyKernels, TriangleIsItsIntegral)
{
  Random random(2);
  for (int round = 0; round < 60; ++round)
  {
    const TriangleCase triangle = randomTriangle(random, round);
    const Vec3 p = triangle.pointNear(random, round);
    const auto line = [&](double s)
    {
      return integrate(
        [&](double t)
        {
          return triangle.measure(p, s, t) *
            bump((p - triangle.at(s, t)).squaredNorm(), triangle.reach(s, t));
        },
        0.0, 1.0 - s, 1e-13);
    };
    const double expected =
      triangleAmplitude(kCauchy) * triangle.jacobian() * integrate(line, 0.0, 1.0, 1e-12);
    ASSERT_NEAR(valueAt(triangle.element(), kCauchy, p), expected, 1e-10)
      << "round " << round << ", slope " << triangle.element().slope;
  }
}

TEST(CauchyKernels, GradientsAreThoseOfTheField)
{
  Random random(3);
  for (int round = 0; round < 300; ++round)
  {
    const SegmentCase segment = randomSegment(random, round);
    expectGradient(segment.element(), kCauchy,
      pointNear(random, segment.start, segment.end, segment.startReach), segment.startReach);
    const TriangleCase triangle = randomTriangle(random, round);
    expectGradient(
      triangle.element(), kCauchy, triangle.pointNear(random, round), triangle.reaches[0]);
  }
}

TEST(CauchyKernels, LongStraightCurvesAndWideSheetsHaveTheirRadius)
{
  const double far = 1e5;
  const SegmentElement line = makeSegmentElement(Vec3(-far, 0, 0), Vec3(far, 0, 0), 2.0, 2.0);
  EXPECT_NEAR(valueAt(line, kCauchy, Vec3(3.0, 0.6, 0.8)), kThreshold, 1e-9);
  const TriangleElement sheet = makeTriangleElement(
    { Vec3(-far, -far, 0), Vec3(far, -far, 0), Vec3(0, 2.0 * far, 0) }, { 2.0, 2.0, 2.0 });
  EXPECT_NEAR(valueAt(sheet, kCauchy, Vec3(3.0, 0.0, -1.0)), kThreshold, 1e-9);
}

// For both kernels: value, gradient and second differences stay below what addBounds() says.
TEST(ElementBounds, AreNotExceeded)
{
  Random random(4);
  for (int round = 0; round < 3000; ++round)
  {
    const ConvolutionKernel kernel =
      round % 2 == 0 ? kCauchy : ConvolutionKernel{ KernelKind::Compact, 2 + round % 7, 2.0 };
    const auto check = [&](const auto& element, const Vec3& p)
    {
      const double distance = distanceTo(element, p);
      const double step = 1e-4 * largestReach(element);
      FieldBounds bounds;
      addBounds(element, kernel, std::max(0.0, distance - step), bounds);
      double value;
      const Vec3 gradient = gradientAt(element, kernel, p, value);
      ASSERT_LE(value, bounds.value * (1.0 + 1e-12)) << "round " << round;
      ASSERT_LE(gradient.norm(), bounds.slope * (1.0 + 1e-9)) << "round " << round;
      const Vec3 way = step * random.direction();
      double ignored;
      const Vec3 change = gradientAt(element, kernel, p + way, ignored) -
        gradientAt(element, kernel, p - way, ignored);
      ASSERT_LE(change.norm() / (2.0 * step), bounds.curvature * (1.0 + 1e-6) + 1e-9)
        << "round " << round;
    };
    const SegmentCase segment = randomSegment(random, round / 2);
    check(
      segment.element(), pointNear(random, segment.start, segment.end, 1.5 * segment.startReach));
    const TriangleCase triangle = randomTriangle(random, round / 2);
    check(triangle.element(), triangle.pointNear(random, 0));
  }
}

} // namespace
} // namespace hybridtree::test
