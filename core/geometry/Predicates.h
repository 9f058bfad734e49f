// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

namespace hybridtree
{

/// Exact signs of small determinants of double coordinates (Shewchuk 1997): a floating-point filter
/// decides nearly always, expansion arithmetic the rest. Exact unless a product under- or
/// overflows.

/// Sign (-1, 0, 1) of det(a - d, b - d, c - d): 1 where d sees a, b, c turn clockwise, that is
/// where d lies on the side opposite to the normal (b - a) x (c - a).
int orientation3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the turn a, b, c in the plane: 1 counter-clockwise, 0 on one line.
int orientation2d(double ax, double ay, double bx, double by, double cx, double cy);

/// Whether three points lie on one line, exactly.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace hybridtree
