// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/TwistMap.h"

#include "core/nodes/BarrZones.h"

#include <cmath>

namespace hybridtree
{
namespace
{

Vec3 turned(const Vec3& p, double angle)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return { c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
}

// Jacobian of turned(p, angle(t)), slope = d angle / dt.
Mat3 twistJacobian(const Vec3& p, double angle, double slope)
{
  const Vec3 image = turned(p, angle);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat3 j;
  j << c, -s, -slope * image[1], s, c, slope * image[0], 0.0, 0.0, 1.0;
  return j;
}

MatrixInterval twistJacobianOver(const Box3& box, const TwistMap& map, double sign)
{
  const Interval t = component(box, 2);
  const double rate = sign * map.angle / (map.end - map.begin);
  const Interval turn = rate * (clamped(t, map.begin, map.end) - Interval{ map.begin, map.begin });
  const Interval slope = zoned(t, map.begin, map.end, { rate, rate }, 0.0);
  const Interval c = cosRange(turn);
  const Interval s = sinRange(turn);
  const Interval x = component(box, 0);
  const Interval y = component(box, 1);
  return MatrixInterval({ c, -s, -(slope * (s * x + c * y)), s, c, slope * (c * x - s * y),
    { 0, 0 }, { 0, 0 }, { 1, 1 } });
}

} // namespace

Vec3 TwistMap::forward(const Vec3& p) const
{
  return turned(p, angle * along(p[2], begin, end));
}

Vec3 TwistMap::inverse(const Vec3& p) const
{
  return turned(p, -angle * along(p[2], begin, end));
}

Mat3 TwistMap::jacobian(const Vec3& p) const
{
  const double slope = within(p[2], begin, end) ? angle / (end - begin) : 0.0;
  return twistJacobian(p, angle * along(p[2], begin, end), slope);
}

Mat3 TwistMap::jacobianInverse(const Vec3& p) const
{
  const double slope = within(p[2], begin, end) ? angle / (end - begin) : 0.0;
  return twistJacobian(this->forward(p), -angle * along(p[2], begin, end), -slope);
}

MatrixInterval TwistMap::jacobianOver(const Box3& box) const
{
  return twistJacobianOver(box, *this, 1.0);
}

std::optional<MatrixInterval> TwistMap::inverseJacobianOver(const Box3& box) const
{
  return twistJacobianOver(box, *this, -1.0);
}

Box3 TwistMap::inverseExtent(const Box3& box) const
{
  const Vec3 far = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  const double radius = std::hypot(far[0], far[1]);
  return Box3(Vec3(-radius, -radius, box.min()[2]), Vec3(radius, radius, box.max()[2]));
}

} // namespace hybridtree
