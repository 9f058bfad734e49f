// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"
#include "core/polygonize/Lattice.h"

#include <cstddef>

namespace hybridtree
{

/// Puts the sharp edges and corners of a field back that marching cubes has cut off (Kobbelt et al.
/// 2001).
///
/// A polygon of marching cubes that is crossed by a crease of more than 30 degrees gets a point on
/// that crease (CreasePoints.h) and triangles around it; where two such polygons share an edge
/// across the crease, it is flipped to run along the crease. No point moves. What turns a triangle
/// over, or makes it cross another one, is taken back, polygon by polygon. So the mesh stays a
/// closed 2-manifold that does not cross itself, if it was one. Notches that are left after that,
/// as where two creases cross a cell, are filled (CreaseNotches.h).
///
/// A mesh without creases is left as it is, bit for bit, for the price of a look at its normals.
/// The triangles of sharpened polygons go, and new ones come last, with sourceLeaf and
/// sourceTriangle -1; the others keep their order. New points come last, with normals in the middle
/// of those of the faces. Points that were in the midst of a polygon may be of no triangle then.
/// The same for any number of threads.
///
/// \param first of the triangles that may be replaced: of marching cubes on the cells of
/// `lattice`, those of one cell one after the other. \pre mesh.normals is full.
/// \return the number of new points. \throws Cancelled.
std::size_t sharpenCreases(const FieldSource& field, const Lattice& lattice, std::size_t first,
  TriangleMesh& mesh, const Progress& progress = Progress::none());

} // namespace hybridtree
