// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Stitch.h"
#include "core/subdivision/LocalField.h"
#include "core/subdivision/PieceMeshes.h"

#include <vector>

namespace hybridtree
{

/// Fills sourceLeaf of the triangles that a joined mesh has from its pieces.
///
/// Most triangles of pieces go where pieces meet, so it is looked for when it is known which stay,
/// and remembered with the mesh of the piece (PieceMesh::sources).
///
/// \param pieces the parts that the mesh was stitched of. \pre the mesh is as stitch() returned it,
/// and the pieces were made of the same field. Thread-safe.
void findPieceSources(const LocalField& field, const std::vector<PieceMeshPtr>& pieces,
  StitchedMesh& joined, const Progress& progress);

} // namespace hybridtree
