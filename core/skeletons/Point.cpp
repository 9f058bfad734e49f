// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Point.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{

PointSkeleton::PointSkeleton(const Vec3& center)
  : KernelSkeleton({ requireFinite("Center", center) })
{
}

Interval PointSkeleton::distanceRange(const Box3& box) const
{
  const Vec3 low = box.min() - shape_.center;
  const Vec3 high = box.max() - shape_.center;
  const Vec3 nearest = low.cwiseMax(-high).cwiseMax(0.0);
  const Vec3 farthest = high.cwiseMax(-low);
  return widenedByRounding({ nearest.norm(), farthest.norm() }, box, this->bounds());
}

Box3 PointSkeleton::bounds() const
{
  return Box3(shape_.center);
}

std::optional<TriangleMesh> PointSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  return meshRoundedBox({ shape_.center, Mat3::Identity(), Vec3::Zero() }, radius, edgeLength);
}

SkeletonPtr PointSkeleton::similarityImage(const Affine3& map, double) const
{
  return std::make_shared<PointSkeleton>(map * shape_.center);
}

Parameters PointSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("center", shape_.center);
  return parameters;
}

SkeletonPtr PointSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<PointSkeleton>(parameters.getVec3("center"));
}

} // namespace hybridtree
