// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

namespace hybridtree
{

/// A directed piece of the line in which a mesh meets the border of a set of cells, within one face
/// of one cell of the set. It runs as the border of the surface inside of that cell does: the
/// triangle outside runs the other way.
struct BorderSegment
{
  Index3 cell{};
  unsigned face = 0; ///< 2 axis + side
  std::int32_t from = 0;
  std::int32_t to = 0;
};

/// Where a mesh passes through an edge of the lattice on the border of a set of cells.
struct BorderCrossing
{
  Index3 low{}; ///< the edge: from this lattice point
  unsigned axis = 0;
  double at = 0.0; ///< coordinate along the axis
  std::int32_t vertex = 0;
};

/// A vertex where a mesh was cut: in triangle `triangle`, at weights (1 - u - v, u, v).
struct CutVertex
{
  Vec3 point;
  std::int32_t triangle = 0;
  double u = 0.0;
  double v = 0.0;
};

/// \param point on a triangle of the mesh.
CutVertex cutVertexOn(const TriangleMesh& mesh, std::int32_t triangle, const Vec3& point);

/// What of a mesh lies outside of a set of lattice cells, and the line along which it was cut.
struct CutMesh
{
  std::vector<std::int32_t> gone;         ///< triangles that are inside or cut; rising
  std::vector<std::int32_t> cutTriangles; ///< of these, those that are cut
  std::vector<Triangle> pieces;           ///< the outer parts of triangles that are cut
  std::vector<std::int32_t> pieceOf;      ///< per piece: the triangle it is a part of
  /// Per piece: false where it goes beyond that triangle, in its plane. Empty: all true.
  std::vector<bool> isPart;
  /// Vertex k of pieces, segments and crossings is point k of the mesh, or, from the number of
  /// points on, a cut vertex.
  std::vector<CutVertex> vertices;
  std::vector<BorderSegment> segments;
  std::vector<BorderCrossing> crossings;
};

/// Cuts a mesh along the border of the cells and leaves out what is inside of them.
///
/// Each triangle that is not clear of the border is split at the planes of the lattice, x first,
/// then y, then z, by comparing coordinates alone: a point in a plane counts as above it. So
/// triangles at an edge, and pieces at a cut, agree on every vertex, and the result is a consistent
/// complex for every input, whatever rounding does; the pieces outside are then put together again
/// and triangulated anew. Vertices of neighbouring triangles never differ: no T-junctions.
///
/// \param candidates triangles, rising: all that may touch the cells (TriangleBlocks::near()).
/// \pre cells is sorted and without diagonal contacts (CellSet::fillDiagonals()); mesh has indices
/// in range. \throws Cancelled.
CutMesh cutMesh(const TriangleMesh& mesh, const std::vector<std::int32_t>& candidates,
  const CellSet& cells, const CellGrid& grid, const Progress& progress = Progress::none());

} // namespace hybridtree
