// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// The area of a result that has no thickness: of triangles that face against the one they are a
/// part of, and of those with another one on their back within `distance`. Looks only at parts of
/// some triangles of the operands.
/// \param among per operand: those triangles, in any order. \param turnsSecond for a difference.
double backToBackArea(const MeshBooleanResult& result,
  const std::array<const TriangleMesh*, 2>& operands,
  const std::array<std::vector<std::int32_t>, 2>& among, bool turnsSecond, double distance);

} // namespace hybridtree
