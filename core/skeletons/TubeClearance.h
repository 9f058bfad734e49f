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
/// Fenchel's theorem the curve turns by pi or more between the ends of such a chord; so only parts
/// that do are compared.
///
/// Where the radius varies the surface is the envelope of the balls, and its normals lean out of
/// the plane across the curve, by asin |s'|. The envelope has to be regular instead, the chord,
/// which is the sum of both radii, stands by as much off right angles, and the curve turns by pi
/// less twice the largest lean. Parts that turn less than that have chords longer than their length
/// times the sine of the lean (Schur's theorem), so that no ball swallows another.
///
/// Curvature, turning, lean and distance are bounded from the control points of parts of the spans:
/// false also when the bounds cannot tell.
bool tubeIsClear(const std::vector<CubicSpan>& spans, bool closed, double radius);

} // namespace hybridtree
