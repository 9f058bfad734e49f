// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/CreasePlanes.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// Angle between vectors of unit length, radians; not a number where one of them is none.
double angleBetween(const Vec3& a, const Vec3& b);

/// Two places on a surface that may have a crease between them.
struct CreasePair
{
  TouchingPlane planes[2]; ///< of the surface there
  Vec3 point;              ///< where the crease would be; moved towards it

  // Told by judgeCreasePairs():
  bool isRound = false;  ///< from near there is no crease, nor did one come in between
  double mostTurn = 0.0; ///< of the normal at once on the way from one to the other, radians
};

/// Looks at all of them from nearer and nearer, with one question to the field for each step. What
/// is hardly bent from near, and has turned by and by, is round.
/// \param leastAngle of a crease, radians. \param reach that a crease may be away.
void judgeCreasePairs(
  const FieldSource& field, double leastAngle, double reach, std::vector<CreasePair>& pairs);

} // namespace hybridtree
