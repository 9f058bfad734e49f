// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hybridtree
{

struct ConvectionOptions
{
  /// Lets the surface pass through facets that are large against the local sampling though no point
  /// lies right behind them: mouths of hollows, holes of handles.
  bool openPockets = true;
  /// A facet is large when its longest edge exceeds this many times the local spacing, which is
  /// the distance of a point to its sixth neighbour or so. No unit, > 1. Smaller values open
  /// narrower hollows and bear less uneven sampling.
  double pocketFactor = 6.0;
};

/// A reconstructed surface: closed, 2-manifold, oriented outward, through points of the input.
struct ReconstructedSurface
{
  /// Points (copies of input points, bit for bit), triangles, and normals (area weighted).
  TriangleMesh mesh;
  /// Per mesh point: index of the input point it is.
  std::vector<std::int32_t> pointIds;
  /// What the user should know; empty if all went as hoped.
  std::vector<std::string> warnings;
};

/// Surface of a solid through a point set, by geometric convection ([HT] 3; R. Chaine, A geometric
/// convection approach of 3-D reconstruction, SGP 2003; static form).
///
/// The surface starts as the convex hull of the Delaunay tetrahedralization, its half-facets
/// oriented inward, and shrinks: a half-facet that is not oriented Gabriel (the inner half of its
/// diametral ball holds a point) is replaced by the other three facets of the tetrahedron behind
/// it, and half-facets that meet back to back cancel. It bounds at any time the tetrahedra not yet
/// passed, so it is closed and oriented.
///
/// Departs from the paper where sampling is too coarse for a sheet or limb. Largest facets move
/// first; a facet that is not large against the local spacing never changes the topology, so thin
/// walls are not torn; a pocket is opened on trial, and closed again where the flow tears off more
/// surface than it finds (an undersampled place of the object, not a pocket). The solid is mended
/// to a manifold at the end by passing or taking back single tetrahedra.
///
/// \param points in any order; coincident points count once. Cost O(n log n) for points on a
/// surface, about 1 KB of memory a point.
/// \throws InvalidGeometry for points that are not finite, fewer than four different ones, or all
/// in one plane. \throws InvalidParameter. \throws Cancelled.
ReconstructedSurface reconstruct(const std::vector<Vec3>& points,
  const ConvectionOptions& options = {}, const Progress& progress = Progress::none());

} // namespace hybridtree
