// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

struct NotchOptions
{
  double cellSize = 0.0;    ///< of the lattice
  double leastCosine = 1.0; ///< between normals at the corners of a triangle that is not bent
  std::size_t first = 0;    ///< of the triangles that may be replaced
  /// Per triangle, or empty: whether it is known to be merely curved, as far as it is bent. There
  /// no notch is looked for unless one may be, or was filled, beside it.
  std::vector<bool> calm;
};

/// Fills the notches that are left where creases cross the cells of a lattice in ways that one
/// point per polygon cannot follow: two creases in a cell, corners beside a crease, wedges that
/// pass between lattice points.
///
/// Edges and triangles of bent triangles that are far from the surface (NotchPoints.h) are parted
/// at a point of the surface over them, or flipped where the other diagonal is on it. In rounds,
/// the highest first. What turns a triangle over or makes it cross another one is not done. No
/// point moves, and edges of triangles before `first` stay, so the mesh stays closed if it was.
///
/// Triangles that are replaced go, and new ones come last with sourceLeaf and sourceTriangle -1;
/// the others keep their order. Bit for bit the same mesh where nothing is that far off. The same
/// for any number of threads.
///
/// \pre mesh.normals is full. \return the number of new points. \throws Cancelled.
std::size_t mendNotches(const FieldSource& field, const NotchOptions& options, TriangleMesh& mesh,
  const Progress& progress);

} // namespace hybridtree
