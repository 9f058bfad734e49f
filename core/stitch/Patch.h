// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/FieldSource.h"
#include "core/polygonize/MemoryBudget.h"
#include "core/stitch/CutMesh.h"

namespace hybridtree
{

/// The line in which the surface outside of the marked cells meets their border.
struct PatchBorder
{
  std::vector<BorderSegment> segments;
  std::vector<BorderCrossing> crossings;
  /// Vertices below this number are the caller's; those of the patch count on from here.
  std::int32_t vertexCount = 0;
  /// Places of the vertices that segments name, by number.
  const Vec3* points = nullptr;
};

/// The surface f = T within marked cells.
struct Patch
{
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  std::vector<Triangle> triangles;
  /// Vertices that are near the surface, but not on it: in the midst of polygons with many sides,
  /// and where the line from outside has overruled the field. Numbers as in triangles.
  std::vector<std::int32_t> unsettled;
  /// Cells in which the line that came from outside and the field do not fit together. The patch
  /// is closed there too, but it should be made anew with these and the cells around them marked.
  std::vector<Index3> misfits;
};

/// Marching cubes on the marked cells of a grid ([HT] 5.2.1), with borders that fit.
///
/// A face between two marked cells has the contour of marching cubes. A face on the border of the
/// set has the given line instead, and an edge on the border the given crossings, any number of
/// them; which corners there are inside follows from these, in the way that agrees with the field
/// at most corners. So the polygons of all cells close, and each is filled on its own: together
/// with what lies outside the result is closed and has no T-junctions, by construction.
///
/// New vertices lie on the surface as those of polygonize(), with the same normals, but for those
/// told. The same for
/// any number of threads. \pre cells is sorted, without diagonal contacts; the line is closed
/// within the border. \throws TooLarge, Cancelled.
Patch makePatch(const FieldSource& field, const CellSet& cells, const CellGrid& grid,
  const PatchBorder& border, const MemoryBudget& budget,
  const Progress& progress = Progress::none());

} // namespace hybridtree
