// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

namespace hybridtree
{

/// f - T at a point.
double excessAt(const FieldSource& field, const Vec3& p);

/// Moves a point along a direction, either way, to the nearest change of side that is no farther
/// than `reach`. \return false where none is found.
/// \param direction unit length.
bool moveToSurface(const FieldSource& field, double reach, const Vec3& direction, Vec3& point);

} // namespace hybridtree
