// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Cone.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{

ConeSkeleton::ConeSkeleton(const Vec3& point1, const Vec3& point2, double radius1, double radius2)
  : KernelSkeleton({ frameBetween(point1, point2), 0.5 * (point2 - point1).stableNorm(),
      requireNotNegative("Radius1", radius1), requireNotNegative("Radius2", radius2) })
  , point1_(point1)
  , point2_(point2)
{
}

Interval ConeSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 ConeSkeleton::bounds() const
{
  return discBounds(point1_, shape_.frame.axis, shape_.bottom)
    .merged(discBounds(point2_, shape_.frame.axis, shape_.top));
}

std::optional<TriangleMesh> ConeSkeleton::offsetMesh(double offset, double edgeLength) const
{
  if (offset + shape_.bottom + shape_.top == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  const double h = shape_.half;
  const std::vector<Vec2> corners = { { 0.0, -h }, { shape_.bottom, -h }, { shape_.top, h },
    { 0.0, h } };
  const bool symmetric = shape_.bottom == shape_.top;
  return meshRevolved(roundedMeridian(corners, offset, symmetric), shape_.frame, edgeLength);
}

SkeletonPtr ConeSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<ConeSkeleton>(
    map * point1_, map * point2_, scale * shape_.bottom, scale * shape_.top);
}

Parameters ConeSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  parameters.set("radius1", shape_.bottom);
  parameters.set("radius2", shape_.top);
  return parameters;
}

SkeletonPtr ConeSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<ConeSkeleton>(parameters.getVec3("point1"), parameters.getVec3("point2"),
    parameters.getDouble("radius1"), parameters.getDouble("radius2"));
}

} // namespace hybridtree
