// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Cylinder.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{

CylinderSkeleton::CylinderSkeleton(const Vec3& point1, const Vec3& point2, double radius)
  : KernelSkeleton({ frameBetween(point1, point2), 0.5 * (point2 - point1).stableNorm(),
      requireNotNegative("Radius", radius) })
  , point1_(point1)
  , point2_(point2)
{
}

Interval CylinderSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 CylinderSkeleton::bounds() const
{
  return discBounds(point1_, shape_.frame.axis, shape_.radius)
    .merged(discBounds(point2_, shape_.frame.axis, shape_.radius));
}

std::optional<TriangleMesh> CylinderSkeleton::offsetMesh(double offset, double edgeLength) const
{
  if (offset + shape_.radius == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  const double r = shape_.radius;
  const double h = shape_.half;
  const std::vector<Vec2> corners = { { 0.0, -h }, { r, -h }, { r, h }, { 0.0, h } };
  return meshRevolved(roundedMeridian(corners, offset, true), shape_.frame, edgeLength);
}

SkeletonPtr CylinderSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<CylinderSkeleton>(map * point1_, map * point2_, scale * shape_.radius);
}

Parameters CylinderSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", point1_);
  parameters.set("point2", point2_);
  parameters.set("radius", shape_.radius);
  return parameters;
}

SkeletonPtr CylinderSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<CylinderSkeleton>(
    parameters.getVec3("point1"), parameters.getVec3("point2"), parameters.getDouble("radius"));
}

} // namespace hybridtree
