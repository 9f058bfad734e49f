// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hybridtree
{

struct ConvectionOptions
{
  /// Lets the surface pass through facets too large for the local sampling though no point lies
  /// right behind them: mouths of hollows, holes of handles.
  bool openPockets = true;
  /// A facet whose longest edge exceeds this many times the local spacing (FacetSize.h) is the
  /// mouth of a pocket whatever lies behind it; a smaller one only where what lies behind is not
  /// much wider. No unit, >= 1, default 6. Raise it where the surface breaks in through a gap.
  double pocketFactor = 6.0;
  /// The surface of a solid, closed over whatever is missing. Off: holes of the sampling are left
  /// open, and so is the border of a sheet (Holes.h); the surface then is a manifold with boundary.
  bool closeHoles = true;
  /// Without closeHoles: diameter of the smallest empty disc that is a hole, in local mean
  /// distances between points. No unit, >= 1.
  double holeFactor = 5.0;
  /// Normals of the points, outward, any length, 0 where unknown; or empty: none. They tell inside
  /// from outside where they are known, so that cavities closed off all around are found too.
  std::vector<Vec3> normals;
  /// Bytes that the work may take, estimated from the number of points before it starts.
  std::size_t maxMemory = std::size_t(16) << 30;
};

/// A reconstructed surface: closed (but for holes that were to be left open), 2-manifold, oriented
/// outward, through points of the input.
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
/// Departs from the paper where sampling is uneven, as when points are drawn at random:
/// - which tetrahedra are empty space around the object and which are inside it is decided first,
///   by a watershed over all facets (Regions.h), so that the flow never leaks through places of
///   thin sampling; this also finds the pockets to be opened;
/// - the flow changes the topology last, and only where it is blocked by a membrane wider than the
///   sampling (Front.h), so thin walls are not torn and uneven sampling makes no handles;
/// - where points are then left hidden, the empty balls of the tetrahedra are asked (BallSides.h),
///   and what they say is taken if it is clear: fine holes, gaps and walls;
/// - the few vertices where it meets itself are mended to a manifold at the end by passing or
///   taking back single tetrahedra (SolidRepair.h).
/// Without closeHoles the flow starts from that part of the hull that is of the outside's colour
/// (Regions.h), which need not be all of it: so it comes to one side of a sheet only. Where points
/// are left out, the empty balls tell the sides of the sheet (SheetSides.h).
/// A cavity that is closed off all around (unless normals tell of it), and a hole or wall about as
/// thin as the points are far apart, may be lost.
///
/// \param points in any order; coincident points count once. Cost O(n log n) for points on a
/// surface, about 1 KB of memory a point.
/// \throws InvalidGeometry for points that are not finite or out of the range of checkExtent(),
/// fewer than four different ones, or all in one plane. \throws InvalidParameter. \throws TooLarge
/// before it starts. \throws Cancelled.
ReconstructedSurface reconstruct(const std::vector<Vec3>& points,
  const ConvectionOptions& options = {}, const Progress& progress = Progress::none());

} // namespace hybridtree
