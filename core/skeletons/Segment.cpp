// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Segment.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{
namespace
{

SegmentShape segmentShape(const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double squared = edge.squaredNorm();
  // A length whose square vanishes is none.
  return { a, edge, squared > 1e-300 ? Vec3(edge / squared) : Vec3(Vec3::Zero()) };
}

} // namespace

SegmentSkeleton::SegmentSkeleton(const Vec3& a, const Vec3& b)
  : KernelSkeleton(segmentShape(requireFinite("Point1", a), requireFinite("Point2", b))), b_(b)
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
  const double length = shape_.edge.stableNorm();
  Mat3 axes = Mat3::Identity();
  if (length > 0.0)
  {
    axes.col(2) = shape_.edge / length;
    axes.col(0) = anyAcross(axes.col(2));
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  const Vec3 middle = this->a() + 0.5 * shape_.edge;
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
