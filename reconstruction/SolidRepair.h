// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// What is to become of spaces that are closed off all around.
enum class Voids : std::uint8_t
{
  Filled,
  Kept ///< but for crumbs
};

/// Changes a set of finite cells, as little as it finds necessary, until its boundary is a closed
/// 2-manifold that encloses no void (unless they are kept), and crumbs are gone: components with
/// fewer than a hundredth of the cells of the largest.
///
/// A boundary vertex is manifold when the cells of the set around it hang together by facets, and
/// so do those not of the set. Where it is not, one cell, one such clump, or all around it change
/// sides: what leaves fewest clumps too many, and among those what reaches least far. Changes that
/// gain something always end; others are allowed a cell a few times only. Vertices that are left
/// after that (none seen on samples of closed surfaces) have their whole star filled, which only
/// grows the set, so this ends too, at worst with the convex hull.
/// \param inside per cell: 1 in the set, 0 not. Infinite cells do not change.
/// \throws Cancelled.
/// \returns how many cells changed sides.
std::size_t repairSolid(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t>& inside,
  Voids voids = Voids::Filled, const Progress& progress = Progress::none());

/// The same for cells on one side of a sheet, which infinite cells are, too: these may change.
std::size_t repairSheet(const Tetrahedralization& tetrahedra, std::vector<std::uint8_t>& inside,
  Voids voids = Voids::Filled, const Progress& progress = Progress::none());

} // namespace hybridtree
