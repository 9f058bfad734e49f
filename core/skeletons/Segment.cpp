// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Segment.h"

#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
SegmentSkeleton::SegmentSkeleton(const Vec3& a, const Vec3& b)
  : KernelSkeleton({ requireFinite("Point1", a), requireFinite("Point2", b) })
{
}

// As convexDistanceRange(), which is asked for every block of cells near a blend: without batches.
Interval SegmentSkeleton::distanceRange(const Box3& box) const
{
  const Vec3 along = this->b() - this->a();
  const double squaredLength = along.squaredNorm();
  const auto fromNearest = [&](const Vec3& p)
  {
    const Vec3 way = p - this->a();
    const double share = squaredLength > 0.0 ? way.dot(along) / squaredLength : 0.0;
    return Vec3(way - std::clamp(share, 0.0, 1.0) * along);
  };
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 p = box.corner(static_cast<Box3::CornerType>(corner));
    most = std::max(most, fromNearest(p).squaredNorm());
  }
  const Vec3 atCenter = fromNearest(box.center());
  const double distance = atCenter.norm();
  const double fall =
    distance > 0.0 ? 0.5 * (atCenter / distance).cwiseAbs().dot(box.sizes()) : 0.0;
  return widenedByRounding({ distance - fall, std::sqrt(most) }, box, this->bounds());
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
