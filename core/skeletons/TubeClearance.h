// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"

#include <vector>

namespace hybridtree
{

/// Whether the surface at `radius` from a smooth curve (and its own radius) surely does not meet
/// itself.
///
/// A tube of radius r is embedded when the curvature is below 1/r, and no chord of length <= 2r
/// stands at right angles on the curve at both ends (or leaves an end of it backwards). By
/// Fenchel's theorem the curve turns by pi or more between the ends of such a chord (less by what
/// normals lean where the radius varies); so only parts that do are compared. Curvature, turning
/// and distance are bounded from the control points of parts of the spans: false also when the
/// bounds cannot tell. The envelope of a varying radius is checked at samples only: meshes of such
/// are to be checked against the distance.
bool tubeIsClear(const std::vector<CubicSpan>& spans, bool closed, double radius);

} // namespace hybridtree
