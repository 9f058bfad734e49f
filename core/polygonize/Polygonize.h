// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <cstddef>

namespace hybridtree
{

struct PolygonizeOptions
{
  /// Side of a lattice cell, world units, finite and > 0. Edges of the mesh are at most sqrt(3) and
  /// on average 0.95 of it.
  double cellSize = 0.0;
  /// Of the lattice; within one cell of the world's.
  Vec3 origin = Vec3::Zero();
  /// Memory the work and the mesh may take together.
  std::size_t maxBytes = std::size_t(8) << 30;
};

/// The surface f = T inside a box, by marching cubes ([HT] 5.2.1, Lorensen and Cline 1987) on the
/// crossed bricks of a lattice.
///
/// The lattice is the same for the whole world: its points are the integer multiples of the cell
/// size, from the origin, so that meshes of different boxes share lattice points bit for bit. Only
/// bricks that the range of the field cannot exclude are sampled, each with the field specialised
/// to it, so time and memory grow with the surface and not with the volume.
///
/// The result is a closed, outward oriented 2-manifold, at edges and at points, for every field,
/// even a discontinuous one, because each lattice point has one side and cells agree on their
/// common face: on a face with two inside corners across its diagonal the field is asked whether
/// these are joined, once for both (AmbiguousFaces.h). A point is inside when f >= T; not-a-number
/// is outside. Outside of `bounds` (rounded outwards to whole cells) the field counts as 0, so a
/// solid that sticks out is closed there, flat.
///
/// Every vertex lies on a lattice edge, at least 1e-4 cells from its ends, and where f is
/// continuous within 1e-4 cells of the surface along it (1e-6 where it is smooth and crosses the
/// edge steeply); a vertex inside a cell exists only where a cell needs one to stay manifold, and
/// is on the surface if there is one within half a cell. Normals are -grad f / |grad f|, from the
/// triangles where the gradient vanishes. Vertices and triangles are the same, byte by byte, for
/// any number of threads.
///
/// \param bounds of the region to search; empty gives an empty mesh.
/// \throws InvalidParameter for a bad cell size or infinite bounds; TooLarge when the work would
/// pass options.maxBytes or the lattice its 2^36 cells a side, with the numbers; Cancelled.
TriangleMesh polygonize(const FieldSource& field, const Box3& bounds,
  const PolygonizeOptions& options, const Progress& progress = Progress::none());

} // namespace hybridtree
