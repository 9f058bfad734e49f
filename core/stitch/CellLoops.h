// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// A vertex on the faces of a cell.
struct CellVertex
{
  std::int32_t vertex = 0;
  unsigned faces = 0; ///< in which it lies: bit 2 axis + side
  Vec3 point = Vec3::Zero();
};

/// A segment in which the surface crosses a face of a cell, as the border of the surface inside of
/// the cell runs.
struct CellSegment
{
  CellVertex from;
  CellVertex to;
};

using CellLoop = std::vector<CellVertex>;

/// Joins the contours on the faces of one cell to closed loops.
/// \return false where some vertex does not have one segment that comes and one that goes; what
/// loops there are are still given.
bool joinSegments(const std::vector<CellSegment>& segments, std::vector<CellLoop>& loops);

/// Triangles over a loop, appended: n - 2 of good shape, with no diagonal in a face of the cell,
/// since the neighbouring cell could have the same. None for a loop of two.
/// \return false where there is always such a diagonal; then nothing is appended.
bool fillLoop(const CellLoop& loop, std::vector<Triangle>& triangles);

} // namespace hybridtree
