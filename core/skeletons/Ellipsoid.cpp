// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Ellipsoid.h"

#include "core/base/Error.h"
#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/EllipsoidMesh.h"
#include "core/skeletons/Validate.h"

#include <algorithm>
#include <array>

namespace hybridtree
{
namespace
{

EllipsoidShape ellipsoidShape(const Vec3& center, const Vec3& radii, const Mat3& rotation)
{
  requireFinite("Center", center);
  for (const double radius : radii)
  {
    if (!std::isfinite(radius) || !(radius > 0.0))
    {
      throw InvalidParameter("Radii", radius, "finite numbers > 0");
    }
  }
  if (radii.maxCoeff() > 1e8 * radii.minCoeff())
  {
    throw InvalidParameter("The largest of Radii over the smallest",
      radii.maxCoeff() / radii.minCoeff(), "at most 1e8; use a disc or a segment instead");
  }
  const Mat3 axes = requireOrthonormal("Rotation", rotation);
  std::array<int, 3> order = { 0, 1, 2 };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return radii[a] > radii[b]; });
  EllipsoidShape shape{ center, Mat3(), Vec3() };
  for (int k = 0; k < 3; ++k)
  {
    shape.radii[k] = radii[order[k]];
    shape.axes.col(k) = axes.col(order[k]);
  }
  return shape;
}

} // namespace

EllipsoidSkeleton::EllipsoidSkeleton(const Vec3& center, const Vec3& radii, const Mat3& rotation)
  : KernelSkeleton(ellipsoidShape(center, radii, rotation))
  , radii_(radii)
  , rotation_(requireOrthonormal("Rotation", rotation))
{
}

Interval EllipsoidSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 EllipsoidSkeleton::bounds() const
{
  const Vec3 half = (shape_.axes * shape_.radii.asDiagonal()).rowwise().norm();
  return Box3(Vec3(shape_.center - half), Vec3(shape_.center + half));
}

std::optional<TriangleMesh> EllipsoidSkeleton::offsetMesh(double radius, double edgeLength) const
{
  return meshEllipsoid(shape_, radius, edgeLength);
}

SkeletonPtr EllipsoidSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<EllipsoidSkeleton>(
    map * shape_.center, scale * radii_, map.linear() * rotation_ / scale);
}

Parameters EllipsoidSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("center", shape_.center);
  parameters.set("radii", radii_);
  const Mat3 columns = rotation_.transpose(); // row by row of the rotation
  parameters.set("rotation", std::vector<double>(columns.data(), columns.data() + 9));
  return parameters;
}

SkeletonPtr EllipsoidSkeleton::fromParameters(const Parameters& parameters)
{
  const std::vector<double> rows = parameters.getDoubles("rotation");
  if (rows.size() != 9)
  {
    throw InvalidText("Parameter \"rotation\" is not a list of 9 numbers.");
  }
  const Mat3 rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  return std::make_shared<EllipsoidSkeleton>(
    parameters.getVec3("center"), parameters.getVec3("radii"), rotation);
}

} // namespace hybridtree
