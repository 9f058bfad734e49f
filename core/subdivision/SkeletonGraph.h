// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Two points of a skeleton, joined.
using SkeletonSegment = std::array<std::int32_t, 2>;

/// A coarse skeleton: branching curves and surfaces that share points ([SUB] 3, Figure 7).
///
/// Plain data. A segment that is also an edge of triangles makes that edge a crease. The
/// orientation of triangles means nothing. Points of no segment and no triangle are allowed and
/// have no effect.
struct SkeletonGraph
{
  std::vector<Vec3> points;
  std::vector<double> radii; ///< one per point, > 0, model lengths: the thickness around it
  std::vector<SkeletonSegment> segments;
  std::vector<Triangle> triangles;
};

/// \throws InvalidGeometry that names the element and what to do, unless there is a segment or a
/// triangle, coordinates are finite, each point has a finite radius > 0, indices are those of
/// points, no element is there twice, segments have a length, triangles an area (no height below
/// 1e-9 of the longest edge), and no edge has more than two triangles.
void validate(const SkeletonGraph& graph);

/// A skeleton after subdivision, and where each of its elements comes from.
///
/// The first points are those of the coarse graph, moved by the scheme, in the same order.
struct RefinedSkeleton : SkeletonGraph
{
  std::vector<std::int32_t> segmentParents;  ///< per segment: the coarse segment it is a part of
  std::vector<std::int32_t> triangleParents; ///< per triangle: the coarse triangle
  /// Per segment: parameters in [0, 1] of its two ends on the parent.
  std::vector<std::array<double, 2>> segmentParameters;
  /// Per triangle and corner: weights of the parent's second and third corner.
  std::vector<std::array<Eigen::Vector2d, 3>> triangleParameters;
};

} // namespace hybridtree
