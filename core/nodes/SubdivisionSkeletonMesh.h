// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SubdivisionSkeleton.h"

namespace hybridtree
{

/// The surface around a skeleton as one closed 2-manifold: the meshes of its pieces where each is
/// alone, the lattice where they meet (SkeletonMesh.h), all of the lattice where they do not fit
/// together, and for a negative leaf nothing. Images under non-similarities are made in the
/// skeleton's own space, mapped and mended.
///
/// Pieces are remembered in the process: after an edit those out of its reach are there already.
/// \param warning what the user should know; untouched if all went well.
TriangleMesh subdivisionSkeletonMesh(const SubdivisionSkeleton& leaf, double edgeLength,
  std::string& warning, const Progress& progress = Progress::none());

/// For a quick look while a skeleton is edited ([SUB] 4): the closed meshes of the pieces, which
/// overlap where they meet, refined by the leaf's own option alone. sourceLeaf is the number of the
/// piece: curves first, then surfaces, each by its first segment or triangle in the coarse graph.
TriangleMesh subdivisionSkeletonPreview(
  const SubdivisionSkeleton& leaf, const Progress& progress = Progress::none());

/// Per point the piece that is nearest in units of the radius there; -1 beyond the reach of all.
void nearestPieces(const SubdivisionSkeleton& leaf, PointBatch points, std::int32_t* pieces);

/// Per triangle of a mesh of the leaf: the piece that is nearest to its center in units of the
/// radius there, numbered as in the preview; -1 beyond the reach of all.
std::vector<std::int32_t> skeletonPieceNumbers(
  const SubdivisionSkeleton& leaf, const TriangleMesh& mesh);

} // namespace hybridtree
