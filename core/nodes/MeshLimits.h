// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <limits>

namespace hybridtree
{

/// What numbers of double precision can hold a mesh of.

/// A shape smaller than this share of its distance from the origin has too few digits left: 1 % of
/// it would be some ten units in the last place.
inline constexpr double kSmallestShare = 1e3 * std::numeric_limits<double>::epsilon();

/// Largest coordinate of a box, by magnitude. \pre not empty.
double largestCoordinate(const Box3& box);

/// True when the box is no smaller than that share of its distance from the origin. \pre not empty.
bool holdsDigits(const Box3& box);

/// \throws InvalidGeometry when a surface in these bounds cannot be meshed: it reaches too far, is
/// too small, or too far away for its size. Bounds of no extent bound no surface, and are right.
void requireRepresentable(const Box3& surface);

/// \throws InvalidParameter unless it is finite and > 0, or 0 for the default.
void requireEdgeLength(double edgeLength);

} // namespace hybridtree
