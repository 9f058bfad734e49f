// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SpaceWarp.h"

#include <vector>

namespace hybridtree
{

/// What a mesh is about to go through: a map, and what its image goes through in turn. For
/// Node::meshToDeform(), which has to know what that will cost.
class Deformation
{
public:
  enum class If
  {
    Always,  ///< the mesh is mapped, come what may
    OneToOne ///< where the map is not one-to-one on it, the mesh is of no use
  };

  /// \param above null for nothing. Both must outlive this.
  Deformation(const SpaceWarp& warp, If mapped, const Deformation* above = nullptr)
    : warp_(warp), mapped_(mapped), above_(above)
  {
  }

  /// Replaces points by their images at the end.
  /// \return false where a map that has to be one-to-one is not, to within `tolerance`.
  bool map(std::vector<Vec3>& points, double tolerance) const;

private:
  const SpaceWarp& warp_;
  const If mapped_;
  const Deformation* above_;
};

/// Some points on a surface.
struct SurfaceSample
{
  struct Point
  {
    Vec3 place;
    Vec3 normal; ///< of unit length
    double area; ///< for which it stands
  };
  std::vector<Point> points;
};

/// What a deformation does to the triangles of a surface, by some points.
struct SurfaceStretch
{
  /// Mean over the area: by how much a tangent vector is lengthened at most; 0 where none is.
  double growth = 0.0;
  /// Thin triangles become clearly thinner somewhere, so that the mesh has to be mended
  /// (warpedMesh()).
  bool spoilsShapes = false;
  bool isOneToOne = true; ///< where it has to be
};

/// \param step between the points of which images are compared: some edge length.
SurfaceStretch stretchOf(const Deformation& deformation, const SurfaceSample& sample, double step);

} // namespace hybridtree
