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

Interval widenedByRounding(Interval distance, const Box3& box, const Box3& skeletonBounds)
{
  const Box3 all = box.merged(skeletonBounds);
  const double slack = 1e-14 * (all.min().cwiseAbs().maxCoeff() + all.max().cwiseAbs().maxCoeff());
  return { std::max(0.0, distance.min - slack), distance.max + slack };
}

} // namespace hybridtree
