// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SplineCurve.h"

namespace hybridtree
{

/// The same kind of curve through fewer of its points (for a B-spline: with fewer control points),
/// such that neither curve is farther than `tolerance` from the other, radii included. Surfaces at
/// a distance from it are then no farther than that from each other, and the field is cheaper.
///
/// Points are chosen by their deviation from the chords (Douglas and Peucker 1973), and the outcome
/// is checked by exact distances from points that lie densely on the curves; more points are kept
/// until it holds. \param tolerance 0 or less: the curve itself. \pre requireCurve().
SplineCurve simplified(const SplineCurve& curve, double tolerance);

/// Most detailed level: the curve itself.
inline constexpr int kExactDetail = 4;

/// Of a level of detail: 2, 1, 0.5 and 0.25 % of the diagonal of the points' bounds for levels 0 to
/// 3, and 0 for kExactDetail. \throws InvalidParameter for other levels.
double detailTolerance(const SplineCurve& curve, int level);
double detailTolerance(const Box3& bounds, int level);

} // namespace hybridtree
