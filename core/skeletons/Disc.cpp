// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Disc.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RevolvedMesh.h"
#include "core/skeletons/RoundShapes.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{

DiscSkeleton::DiscSkeleton(const Vec3& center, const Vec3& normal, double radius)
  : KernelSkeleton({ frameAlong("Normal", requireFinite("Center", center), normal),
      requireNotNegative("Radius", radius) })
{
}

Interval DiscSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 DiscSkeleton::bounds() const
{
  return discBounds(this->center(), this->normal(), shape_.radius);
}

std::optional<TriangleMesh> DiscSkeleton::offsetMesh(double offset, double edgeLength) const
{
  if (offset == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  if (shape_.radius == 0.0)
  {
    return meshRoundedBox({ this->center(), Mat3::Identity(), Vec3::Zero() }, offset, edgeLength);
  }
  const Vec2 middle = Vec2::Zero();
  return meshRevolved(roundedMeridian({ middle, Vec2(shape_.radius, 0.0), middle }, offset, true),
    shape_.frame, edgeLength);
}

SkeletonPtr DiscSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<DiscSkeleton>(
    map * this->center(), map.linear() * this->normal(), scale * shape_.radius);
}

Parameters DiscSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("center", this->center());
  parameters.set("normal", this->normal());
  parameters.set("radius", shape_.radius);
  return parameters;
}

SkeletonPtr DiscSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<DiscSkeleton>(
    parameters.getVec3("center"), parameters.getVec3("normal"), parameters.getDouble("radius"));
}

} // namespace hybridtree
