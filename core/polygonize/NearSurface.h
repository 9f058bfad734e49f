// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// f - T at a point,
double excessAt(const FieldSource& field, const Vec3& p);
/// and at many.
std::vector<double> excessAt(const FieldSource& field, const std::vector<Vec3>& points);

/// Moves a point along a direction, either way, to the nearest change of side that is no farther
/// than `reach`. \return false where none is found.
/// \param direction unit length.
bool moveToSurface(const FieldSource& field, double reach, const Vec3& direction, Vec3& point);

/// A point to be moved.
struct SurfaceMove
{
  Vec3 point = Vec3::Zero();     ///< stays where no surface is found
  Vec3 direction = Vec3::Zero(); ///< unit length, or 0: nothing is found
  bool found = false;
};

/// As above, step by step for all together: the field is asked for many points at once.
void moveToSurface(const FieldSource& field, double reach, std::vector<SurfaceMove>& moves);

} // namespace hybridtree
