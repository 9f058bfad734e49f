// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/Lattice.h"

#include <vector>

namespace hybridtree
{

/// A polygon in one cell of a lattice that marching cubes has filled with triangles.
struct CreaseLoop
{
  Index3 cell{};
  /// The triangles follow one another in the mesh.
  std::size_t firstTriangle = 0;
  std::size_t triangleCount = 0;
  /// Points of the mesh, counter-clockwise seen from outside.
  std::vector<std::int32_t> corners;
};

/// The polygons with an edge or a diagonal whose ends have normals further apart than an angle:
/// those that a crease may cross. In the order of their triangles.
///
/// Polygons that are no discs with at most one point in their midst are left out.
/// \param first of the triangles to look at; those of one cell follow one another.
/// \param leastCosine of the angle. \pre mesh.normals is full. \throws Cancelled.
std::vector<CreaseLoop> findCreaseLoops(const TriangleMesh& mesh, std::size_t first,
  const Lattice& lattice, double leastCosine, const Progress& progress);

/// The cell of a lattice in which a point lies.
Index3 cellOf(const Lattice& lattice, const Vec3& point);

} // namespace hybridtree
