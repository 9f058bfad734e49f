// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/PlateKernels.h"
#include "core/skeletons/KernelSkeleton.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// What the flat skeletons share: rectangle, triangle and polygon are outlines in a plane. They
/// have no inside; their offset surfaces are two faces and a round rim.
class PlateSkeleton : public KernelSkeleton<PlateShape>
{
public:
  double distanceCost() const override { return kClosedForm; }
  /// Exact to second order in the size of the box; of an outline that is not convex the least and
  /// the most over its triangles.
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  /// Empty where the rim meets itself, in notches narrower than twice the radius.
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;

  /// The outline, counter-clockwise seen from the side the normal points to.
  std::vector<Vec3> corners() const;
  Vec3 normal() const { return shape_.axes.col(2); }

protected:
  explicit PlateSkeleton(const PlateShape& shape);

private:
  // Of an outline that is not convex, in its plane; else empty.
  std::vector<std::array<Vec3, 3>> triangles_;
};

/// The plate with these corners. \param corners 3 or more, in order around, their plane that of
/// Newell's normal, onto which they are projected.
/// \param tolerance most a corner may lie off the plane, as a share of the diagonal of the corners'
/// bounds.
/// \param name of the property that an error message names.
/// \throws InvalidParameter when a number is not finite, fewer than 3 corners differ, the outline
/// has no area, meets itself, or is not flat.
PlateShape plateThrough(
  const std::string& name, const std::vector<Vec3>& corners, double tolerance);

} // namespace hybridtree
