// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Triangle.h"

namespace hybridtree
{

TriangleSkeleton::TriangleSkeleton(const Vec3& point1, const Vec3& point2, const Vec3& point3)
  : PlateSkeleton(plateThrough("Point1, Point2, Point3", { point1, point2, point3 }, 1e-9))
  , point1_(point1)
  , point2_(point2)
  , point3_(point3)
{
}

SkeletonPtr TriangleSkeleton::similarityImage(const Affine3& map, double) const
{
  return std::make_shared<TriangleSkeleton>(map * point1_, map * point2_, map * point3_);
}

Parameters TriangleSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  parameters.set("point3", point3_);
  return parameters;
}

SkeletonPtr TriangleSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<TriangleSkeleton>(
    parameters.getVec3("point1"), parameters.getVec3("point2"), parameters.getVec3("point3"));
}

} // namespace hybridtree
