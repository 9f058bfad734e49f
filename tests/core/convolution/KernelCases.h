// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionKernels.h"
#include "core/geometry/PointTriangle.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{

inline double valueAt(const SegmentElement& element, const ConvolutionKernel& kernel, const Vec3& p)
{
  const SegmentElement* pointer = &element;
  double sum = 0.0;
  convolutionKernels(kernel.kind)
    .addSegments({ &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &sum);
  return sum;
}

inline double valueAt(
  const TriangleElement& element, const ConvolutionKernel& kernel, const Vec3& p)
{
  const TriangleElement* pointer = &element;
  double sum = 0.0;
  convolutionKernels(kernel.kind)
    .addTriangles({ &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &sum);
  return sum;
}

inline Vec3 gradientAt(
  const SegmentElement& element, const ConvolutionKernel& kernel, const Vec3& p, double& value)
{
  const SegmentElement* pointer = &element;
  Vec3 g = Vec3::Zero();
  value = 0.0;
  convolutionKernels(kernel.kind)
    .addSegmentsWithGradient(
      { &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &value, { &g.x(), &g.y(), &g.z() });
  return g;
}

inline Vec3 gradientAt(
  const TriangleElement& element, const ConvolutionKernel& kernel, const Vec3& p, double& value)
{
  const TriangleElement* pointer = &element;
  Vec3 g = Vec3::Zero();
  value = 0.0;
  convolutionKernels(kernel.kind)
    .addTrianglesWithGradient(
      { &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &value, { &g.x(), &g.y(), &g.z() });
  return g;
}

/// Against central differences of second and fourth order, whichever is nearer: at the rim of the
/// reach only few derivatives exist.
template <class Element>
void expectGradient(
  const Element& element, const ConvolutionKernel& kernel, const Vec3& p, double size)
{
  double value;
  const Vec3 gradient = gradientAt(element, kernel, p, value);
  ASSERT_NEAR(value, valueAt(element, kernel, p), 1e-14);
  const double step = 1e-4 * size;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto slope = [&](double h)
    {
      return (valueAt(element, kernel, p + h * Vec3::Unit(axis)) -
               valueAt(element, kernel, p - h * Vec3::Unit(axis))) /
        (2.0 * h);
    };
    const double expected = (4.0 * slope(step) - slope(2.0 * step)) / 3.0;
    ASSERT_NEAR(gradient[axis] * size, expected * size, 2e-6)
      << "axis " << axis << " at " << p.transpose() << ", slope " << element.slope;
  }
}

/// With reaches about 1, some constant, some steeper than 1.
struct SegmentCase
{
  Vec3 start, end;
  double startReach, endReach;

  double length() const { return (end - start).norm(); }
  Vec3 at(double s) const { return start + s / this->length() * (end - start); }
  double reach(double s) const { return startReach + s / this->length() * (endReach - startReach); }
  SegmentElement element() const { return makeSegmentElement(start, end, startReach, endReach); }
  /// Density of the measure at arclength s, as ConvolutionElement.h defines it.
  double measure(const Vec3& p, double s) const
  {
    const Vec3 direction = (end - start).normalized();
    const double x = direction.dot(p - start);
    const double slope = (endReach - startReach) / this->length();
    const double height = (p - start - x * direction).norm();
    return std::hypot(startReach + slope * x, slope * height) / std::pow(this->reach(s), 2);
  }
};

inline SegmentCase randomSegment(Random& random, int round)
{
  SegmentCase segment;
  segment.start = 3.0 * random.direction();
  segment.end = segment.start + std::pow(10.0, random.uniform(-1.0, 0.7)) * random.direction();
  segment.startReach = random.uniform(0.4, 1.5);
  segment.endReach = round % 3 == 0 ? segment.startReach
    : round % 3 == 1                ? segment.startReach * (1.0 + random.uniform(-1e-3, 1e-3))
                                    : random.uniform(0.3, 2.0);
  return segment;
}

/// Within reach, and a little beyond.
inline Vec3 pointNear(Random& random, const Vec3& start, const Vec3& end, double reach)
{
  return start + random.uniform(-0.2, 1.2) * (end - start) +
    random.uniform(0.0, 1.2) * reach * random.direction();
}

struct TriangleCase
{
  std::array<Vec3, 3> corners;
  std::array<double, 3> reaches;

  Vec3 at(double s, double t) const
  {
    return corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]);
  }
  double reach(double s, double t) const
  {
    return reaches[0] + s * (reaches[1] - reaches[0]) + t * (reaches[2] - reaches[0]);
  }
  Vec3 normal() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }
  double jacobian() const { return this->normal().norm(); }
  TriangleElement element() const { return makeTriangleElement(corners, reaches); }
  double measure(const Vec3& p, double s, double t) const
  {
    // R at the projection, by its weights.
    const Vec3 n = this->normal();
    const double squared = n.squaredNorm();
    const Vec3 d = p - corners[0];
    const double ps = d.cross(corners[2] - corners[0]).dot(n) / squared;
    const double pt = (corners[1] - corners[0]).cross(d).dot(n) / squared;
    const double slope = this->element().slope;
    const double height = d.dot(n.normalized());
    return std::hypot(this->reach(ps, pt), slope * height) / std::pow(this->reach(s, t), 3);
  }
  /// Anywhere within reach; on every other round in special position: in the plane, on an edge, a
  /// corner, or the extension of an edge.
  Vec3 pointNear(Random& random, int round) const
  {
    switch (round % 10)
    {
      case 1:
        return this->at(random.uniform(-0.3, 1.0), random.uniform(-0.3, 1.0));
      case 3:
        return this->at(random.unit(), 0.0);
      case 5:
        return corners[std::size_t(round) % 3];
      case 7:
        return this->at(1.0 + 0.3 * random.unit(), 0.0);
      case 9:
        return this->at(0.0, -0.3 * random.unit()) + 0.4 * reaches[0] * this->normal().normalized();
      default:
        return this->at(random.unit(), random.unit()) +
          random.uniform(0.0, 1.1) * reaches[0] * random.direction();
    }
  }
};

inline TriangleCase randomTriangle(Random& random, int round)
{
  TriangleCase triangle;
  const double size = std::pow(10.0, random.uniform(-0.7, 0.6));
  do
  {
    const Vec3 center = 2.0 * random.direction();
    for (Vec3& corner : triangle.corners)
    {
      corner = center + size * random.direction();
    }
  } while (triangle.jacobian() < 0.05 * size * size);
  const double reach = random.uniform(0.5, 1.5);
  for (double& value : triangle.reaches)
  {
    value = round % 3 == 0 ? reach
      : round % 3 == 1     ? reach * (1.0 + random.uniform(-1e-3, 1e-3))
                           : random.uniform(0.4, 1.8);
  }
  return triangle;
}

} // namespace hybridtree::test
