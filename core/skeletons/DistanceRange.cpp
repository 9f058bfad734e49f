// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/DistanceRange.h"

#include <algorithm>

namespace hybridtree
{

Interval convexDistanceRange(const Skeleton& skeleton, const Box3& box)
{
  double x[9], y[9], z[9];
  for (int corner = 0; corner < 8; ++corner)
  {
    x[corner] = (corner & 1) ? box.max().x() : box.min().x();
    y[corner] = (corner & 2) ? box.max().y() : box.min().y();
    z[corner] = (corner & 4) ? box.max().z() : box.min().z();
  }
  const Vec3 center = box.center();
  double distance[8];
  skeleton.distance({ x, y, z, 8 }, distance);

  double atCenter, gx, gy, gz;
  skeleton.distanceAndGradient(
    { &center.x(), &center.y(), &center.z(), 1 }, &atCenter, { &gx, &gy, &gz });
  const double fall = 0.5 * Vec3(gx, gy, gz).cwiseAbs().dot(box.sizes());
  return widenedByRounding(
    { atCenter - fall, *std::max_element(distance, distance + 8) }, box, skeleton.bounds());
}

AxisRange axisRange(const Box3& box, const Vec3& origin, const Vec3& axis)
{
  const Vec3 half = 0.5 * box.sizes();
  const Vec3 center = box.center() - origin;
  const double height = axis.dot(center);
  const double heightReach = axis.cwiseAbs().dot(half);

  // Distance to the axis: convex, so the largest is at a corner, and it lies above its tangent
  // plane.
  const Vec3 radial = center - height * axis;
  const double radius = radial.norm();
  double least = 0.0;
  if (radius > 0.0)
  {
    least = std::max(0.0, radius - (radial / radius).cwiseAbs().dot(half));
  }
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 p = box.corner(static_cast<Box3::CornerType>(corner)) - origin;
    most = std::max(most, (p - axis.dot(p) * axis).norm());
  }
  return { { height - heightReach, height + heightReach }, { least, most } };
}

Interval withinReach(Interval distance, const Skeleton& skeleton, const Box3& box)
{
  const Vec3 center = box.center();
  const double reach = 0.5 * box.sizes().norm();
  double atCenter;
  skeleton.distance({ &center.x(), &center.y(), &center.z(), 1 }, &atCenter);
  return widenedByRounding(
    { std::max(distance.min, atCenter - reach), std::min(distance.max, atCenter + reach) }, box,
    skeleton.bounds());
}

Interval widenedByRounding(Interval distance, const Box3& box, const Box3& skeletonBounds)
{
  const Box3 all = box.merged(skeletonBounds);
  const double slack = 1e-14 * (all.min().cwiseAbs().maxCoeff() + all.max().cwiseAbs().maxCoeff());
  return { std::max(0.0, distance.min - slack), distance.max + slack };
}

} // namespace hybridtree
