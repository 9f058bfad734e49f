// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Stitch.h"
#include "core/subdivision/PieceMeshes.h"

#include <optional>

namespace hybridtree
{

struct SkeletonMeshOptions
{
  /// Side of the lattice's cells, world units; edges elsewhere are at most 4/3 of it.
  double edgeLength = 0.0;
  /// As PieceMeshOptions.
  double refinement = 0.1;
  std::size_t maxBytes = std::size_t(8) << 30;
};

/// The surface around a skeleton as one closed, oriented 2-manifold.
///
/// The meshes of the pieces, as they are, where one of them is alone; where they overlap (or one
/// overlaps itself, is inside of others, or misses the surface by more than twice its tolerance)
/// the cells of a lattice are marked, the meshes cut along their border and the surface inside made
/// by marching cubes (Stitch.h). [SUB] leaves the overlaps.
///
/// What is there of earlier meshes (pieces, the cells they are in, islands of marked cells) is
/// taken from them where neither pieces nor field have changed within reach: the result is the
/// same, bit for bit. \param cache as pieceMeshes(). \return nothing where the parts do not fit
/// together: then the whole has to be polygonized. \throws TooLarge, Cancelled.
std::optional<StitchedMesh> skeletonMesh(const SkeletonField& skeleton,
  const SkeletonMeshOptions& options, PieceMeshCache* cache = nullptr,
  const Progress& progress = Progress::none());

/// Cells in which the surface is not that of one piece alone: see skeletonMesh(). Sorted.
CellSet cellsWherePiecesMeet(const std::vector<PieceMeshPtr>& pieces, const SkeletonField& skeleton,
  double refinement, const CellGrid& grid);

} // namespace hybridtree
