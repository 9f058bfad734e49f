// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Rectangle.h"

namespace hybridtree
{

RectangleSkeleton::RectangleSkeleton(const Vec3& origin, const Vec3& point1, const Vec3& point2)
  : PlateSkeleton(plateThrough(
      "Origin, Point1, Point2", { origin, point1, point1 + (point2 - origin), point2 }, 1e-9))
  , origin_(origin)
  , point1_(point1)
  , point2_(point2)
{
}

SkeletonPtr RectangleSkeleton::similarityImage(const Affine3& map, double) const
{
  return std::make_shared<RectangleSkeleton>(map * origin_, map * point1_, map * point2_);
}

Parameters RectangleSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("origin", origin_);
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  return parameters;
}

SkeletonPtr RectangleSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<RectangleSkeleton>(
    parameters.getVec3("origin"), parameters.getVec3("point1"), parameters.getVec3("point2"));
}

} // namespace hybridtree
