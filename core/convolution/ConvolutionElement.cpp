// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionElement.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kRounding = 1e-9; // of the size of a ball

/// Around a center of an element.
ElementBall ballAround(const Vec3& center, double size, double reach)
{
  const double radius = (1.0 + kRounding) * (size + reach);
  return { center, radius * radius };
}

} // namespace

SegmentElement makeSegmentElement(
  const Vec3& start, const Vec3& end, double startReach, double endReach)
{
  const Vec3 along = end - start;
  const double length = along.norm();
  return { start, along / length, length, startReach, (endReach - startReach) / length,
    1.0 / startReach, 1.0 / endReach,
    ballAround(0.5 * (start + end), 0.5 * length, std::max(startReach, endReach)) };
}

TriangleElement makeTriangleElement(
  const std::array<Vec3, 3>& corners, const std::array<double, 3>& reaches)
{
  const Vec3 a = corners[1] - corners[0];
  const Vec3 b = corners[2] - corners[0];
  const Vec3 normal = a.cross(b);
  const double squaredArea = normal.squaredNorm();
  // The slope of the linear function that has the differences of R along both sides.
  const Vec3 gradient =
    ((reaches[1] - reaches[0]) * b.cross(normal) + (reaches[2] - reaches[0]) * normal.cross(a)) /
    squaredArea;
  TriangleElement element;
  element.origin = corners[0];
  element.originReach = reaches[0];
  // A gradient that is rounding has no direction.
  const bool sloped = reaches[1] != reaches[0] || reaches[2] != reaches[0];
  element.slope = sloped ? gradient.norm() : 0.0;
  const Vec3 up = normal / std::sqrt(squaredArea);
  const Vec3 along = sloped ? Vec3(gradient.normalized()) : Vec3(a.normalized());
  element.axes.col(1) = up.cross(along).normalized();
  element.axes.col(0) = element.axes.col(1).cross(up);
  element.axes.col(2) = up;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vec3 local = element.axes.transpose() * (corners[k] - corners[0]);
    element.x[k] = local.x();
    element.y[k] = local.y();
    element.inverse[k] = 1.0 / reaches[k];
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t next = (k + 1) % 3;
    const double dx = element.x[next] - element.x[k];
    const double dy = element.y[next] - element.y[k];
    element.inverseLength[k] = 1.0 / std::hypot(dx, dy);
    element.edgeX[k] = dx * element.inverseLength[k];
    element.edgeY[k] = dy * element.inverseLength[k];
  }
  const Vec3 center = (corners[0] + corners[1] + corners[2]) / 3.0;
  double size = 0.0;
  for (const Vec3& corner : corners)
  {
    size = std::max(size, (corner - center).norm());
  }
  element.ball = ballAround(center, size, std::max(reaches[0], std::max(reaches[1], reaches[2])));
  return element;
}

} // namespace hybridtree
