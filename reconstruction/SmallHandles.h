// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Takes away handles no larger than the sampling: where the surface pierces itself among a few
/// neighbouring points, which at random places says more about the sampling than about the object.
///
/// Around each vertex of the surface, the small cells outside the solid are put into it, or those
/// inside taken out, where this removes a handle and neither tears the solid nor encloses a void.
/// The boundary stays a closed 2-manifold.
/// \param inside per cell: 1 in the solid, 0 not. \pre its boundary is a 2-manifold.
/// \param small largest size of cells that change sides (FacetSize.h).
/// \returns how many handles were removed. \throws Cancelled.
std::size_t removeSmallHandles(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double small, std::vector<std::uint8_t>& inside, const Progress& progress = Progress::none());

} // namespace hybridtree
