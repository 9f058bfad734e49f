// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// What closeHoles() has done.
struct ClosedHoles
{
  std::size_t holes = 0; ///< closed
  std::size_t left = 0;  ///< still open
  /// Per point that was added, which come last: a point of the hole it lies in.
  std::vector<std::int32_t> addedFrom;
};

/// Closes every loop of open edges by triangles between its points, of the smallest area there is
/// (Barequet and Sharir 1995), the better shaped ones where areas are alike; loops of more than 400
/// points, whose smallest area would take long, along every n-th of them first, 20th at most. Its
/// old points and triangles stay where they are in the lists, the new ones come last, and closed
/// shells then face as orientTriangles() has it.
///
/// New triangles are joined to others along the loop alone: where its points are too close for
/// that (edges of the mesh run between them), or where loops touch, a point in its middle is added
/// and joined to all of it.
///
/// Left open are loops that lie on one line (T-junctions), and those that pass edges of more than
/// two triangles or neighbours that disagree on what is outside. An open sheet has one loop, its
/// border: closed, it is a shell without thickness.
///
/// \pre as repairMesh() leaves it; without the optional arrays, but normals, which go.
/// \throws Cancelled
ClosedHoles closeHoles(TriangleMesh& mesh, const Progress& progress = Progress::none());

} // namespace hybridtree
