// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellSet.h"
#include "core/subdivision/PieceMesh.h"

#include <memory>

namespace hybridtree
{

/// Where the mesh of one piece is, in the cells of a lattice.
struct PieceCells
{
  CellSet all;
  /// Of these, those in which it is not the surface: where it ends inside of other pieces, misses
  /// the surface by more than its tolerance, or overlaps itself.
  CellSet unsettled;
};

/// \param tolerance of the field at the centers of triangles.
PieceCells findPieceCells(
  const PieceMesh& piece, const PlacedField& field, double tolerance, const CellGrid& grid);

/// The same, remembered as long as anyone holds the mesh. \pre the field near the mesh is the one
/// that it was made in, and has not changed since.
std::shared_ptr<const PieceCells> pieceCells(const std::shared_ptr<const PieceMesh>& piece,
  const PlacedField& field, double tolerance, const CellGrid& grid);

} // namespace hybridtree
