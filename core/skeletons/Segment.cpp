// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Segment.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{
SegmentSkeleton::SegmentSkeleton(const Vec3& a, const Vec3& b)
  : KernelSkeleton({ requireFinite("Point1", a), requireFinite("Point2", b) })
{
}

Interval SegmentSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 SegmentSkeleton::bounds() const
{
  return Box3(this->a()).extend(this->b());
}

std::optional<TriangleMesh> SegmentSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius == 0.0)
  {
    return TriangleMesh(); // encloses nothing
  }
  const Vec3 edge = this->b() - this->a();
  const double length = edge.stableNorm();
  Mat3 axes = Mat3::Identity();
  if (length > 0.0)
  {
    axes.col(2) = edge / length;
    axes.col(0) = anyAcross(axes.col(2));
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  const Vec3 middle = this->a() + 0.5 * edge;
  return meshRoundedBox({ middle, axes, Vec3(0.0, 0.0, 0.5 * length) }, radius, edgeLength);
}

SkeletonPtr SegmentSkeleton::similarityImage(const Affine3& map, double) const
{
  return std::make_shared<SegmentSkeleton>(map * this->a(), map * this->b());
}

Parameters SegmentSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("point1", this->a());
  parameters.set("point2", this->b());
  return parameters;
}

SkeletonPtr SegmentSkeleton::fromParameters(const Parameters& parameters)
{
  return std::make_shared<SegmentSkeleton>(
    parameters.getVec3("point1"), parameters.getVec3("point2"));
}

} // namespace hybridtree
