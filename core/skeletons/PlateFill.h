// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/PlateFace.h"

#include <optional>

namespace hybridtree
{

/// A face of any outline: a triangular lattice inside, whose triangles are written down as they
/// are, and a strip between it and the outline, which is Delaunay and smoothed. The time of the
/// strip goes with the length of the outline, and not with the area.
///
/// No value where the lattice inside is not one piece without holes and pinches: where the outline
/// has necks or is no wider than a few spacings.
/// \param outline its points in order, `spacing` apart or less.
/// \param longest no inner edge is longer.
/// \pre corners are as PlanarTriangulation has them.
std::optional<PlateFace> fillOutline(const std::vector<Vec2>& corners,
  const std::vector<Vec2>& outline, double spacing, double longest);

} // namespace hybridtree
