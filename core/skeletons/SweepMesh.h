// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"
#include "core/mesh/TriangleMesh.h"

#include <optional>
#include <vector>

namespace hybridtree
{

/// Mesh of the surface at `radius` from a chain of spans and their own radius ([HT] 5.1): a closed
/// 2-manifold with edges <= edgeLength and exact points and normals.
///
/// Planned as the surface of revolution that the tube would be if the curve were straight, with
/// lengths as on the outer side of its bends, and then bent: rings stand across the curve in
/// rotation-minimising frames (double reflection, Wang, Juettler, Zheng, Liu 2008), round ends
/// share their last rings. Closed curves spread the twist that is left over all rings.
///
/// No value where the surface meets itself, or bounds cannot tell (tubeIsClear()), or the curve has
/// a corner or stands still. \pre radius >= 0, edgeLength > 0. \throws TooLarge.
std::optional<TriangleMesh> meshSweep(
  const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength);

} // namespace hybridtree
