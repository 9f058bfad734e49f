// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Box.h"

#include "core/base/Error.h"
#include "core/skeletons/DistanceRange.h"
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/Validate.h"

namespace hybridtree
{
namespace
{

BoxShape boxShape(const Vec3& center, const Vec3& lengths, const Mat3& rotation)
{
  requireFinite("Center", center);
  for (const double length : lengths)
  {
    requireNotNegative("Lengths", length);
  }
  return { center, requireOrthonormal("Rotation", rotation), 0.5 * lengths };
}

} // namespace

BoxSkeleton::BoxSkeleton(const Vec3& center, const Vec3& lengths, const Mat3& rotation)
  : KernelSkeleton(boxShape(center, lengths, rotation))
{
}

Interval BoxSkeleton::distanceRange(const Box3& box) const
{
  return convexDistanceRange(*this, box);
}

Box3 BoxSkeleton::bounds() const
{
  const Vec3 half = shape_.axes.cwiseAbs() * shape_.half;
  return Box3(Vec3(shape_.center - half), Vec3(shape_.center + half));
}

std::optional<TriangleMesh> BoxSkeleton::offsetMesh(double radius, double edgeLength) const
{
  if (radius > 0.0)
  {
    return meshRoundedBox(shape_, radius, edgeLength);
  }
  const bool flat = shape_.half.minCoeff() == 0.0; // encloses nothing
  return flat ? TriangleMesh() : meshSharpBox(shape_, edgeLength);
}

SkeletonPtr BoxSkeleton::similarityImage(const Affine3& map, double scale) const
{
  return std::make_shared<BoxSkeleton>(
    map * shape_.center, scale * this->lengths(), map.linear() * shape_.axes / scale);
}

Parameters BoxSkeleton::parameters() const
{
  Parameters parameters;
  parameters.set("center", shape_.center);
  parameters.set("lengths", this->lengths());
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      rows.push_back(shape_.axes(row, column));
    }
  }
  parameters.set("rotation", std::move(rows));
  return parameters;
}

SkeletonPtr BoxSkeleton::fromParameters(const Parameters& parameters)
{
  const std::vector<double> rows = parameters.getDoubles("rotation");
  if (rows.size() != 9)
  {
    throw InvalidText("Parameter \"rotation\" is not a list of 9 numbers.");
  }
  const Mat3 rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  return std::make_shared<BoxSkeleton>(
    parameters.getVec3("center"), parameters.getVec3("lengths"), rotation);
}

} // namespace hybridtree
