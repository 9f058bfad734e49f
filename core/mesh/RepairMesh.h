// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hybridtree
{

/// A mesh fit to be a leaf, and what was done to make it so.
struct RepairedMesh
{
  MeshPtr mesh;
  /// Per input point: its point of the mesh; -1 where no kept triangle uses it.
  std::vector<std::int32_t> pointMap;
  /// Per triangle of the mesh: the input triangle it is.
  std::vector<std::int32_t> triangleMap;
  /// One sentence per kind of repair, with its count. Empty for a clean mesh.
  std::vector<std::string> warnings;
  /// The same of what is still wrong, of which a mesh leaf warns, too.
  std::vector<std::string> faults;
};

/// Makes a consistent triangle mesh out of what files and other programs deliver:
/// - points with exactly equal coordinates become one (-0 equals 0), so that closed surfaces with
///   doubled seams close; unused points go;
/// - points of open edges that differ by rounding only (Seams.h) become one, if that leaves fewer
///   open edges and no more edges of more than two triangles;
/// - triangles with a repeated corner or three corners on one line are dropped, and so are second
///   copies of a triangle (whichever way round);
/// - open pieces of a few triangles are dropped where without them the mesh is closed
///   (LooseTriangles.h);
/// - neighbours across an edge of two triangles are brought to one orientation, and closed shells
/// to
///   point outward, or inward where a shell bounds a cavity: it lies inside an odd number of
///   others.
/// What cannot be repaired without inventing surface stays and is told: open edges, edges of more
/// than two triangles, shells that have no two sides. The kept points and triangles stay in order,
/// bit-identical in coordinates.
///
/// Open edges that come from dropping a flat triangle between unequal subdivisions (T-junctions)
/// are told as such: no gap is visible, but the mesh is not closed, so its inside is then found by
/// the winding number.
///
/// \param triangles indices into points.
/// \throws InvalidGeometry naming the element: a coordinate of a used point not finite, an index
/// out of range, no triangles at all, or none left.
RepairedMesh repairMesh(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

} // namespace hybridtree
