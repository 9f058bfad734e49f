// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/stitch/Patch.h"
#include "core/stitch/PatchBricks.h"

namespace hybridtree
{

/// Puts a vertex on every lattice edge whose four cells are marked and whose ends are on different
/// sides: numbers them in the bricks, from `first` on, and fills points, normals and unsettled of
/// the patch. \pre the sides of the border's corners are aligned (BorderSigns.h).
/// \throws Cancelled.
void makePatchVertices(PatchBricks& bricks, const Lattice& lattice, std::int32_t first,
  Patch& patch, const Progress& progress);

} // namespace hybridtree
