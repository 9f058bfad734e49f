// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "core/stitch/KeptMesh.h"

namespace hybridtree
{

/// Gives what is left of large cut triangles a better shape: they and some around them (CutZone.h)
/// are triangulated anew with more points (RefineFacets.h), so that triangles grow gradually from
/// the cut, which has sides of a cell, to the corners of the mesh.
///
/// The surface stays the same, and so does every triangle outside of the zone. Triangles of the
/// zone that were not cut are among cutTriangles and gone then. Pieces over several triangles of
/// one plane are of the one in which their middle lies, and not part of it. Nothing changes where
/// no cut triangle is larger than two cells.
void gradeCut(const TriangleMesh& mesh, const KeptMesh& known, double cellSize, CutMesh& cut);

} // namespace hybridtree
