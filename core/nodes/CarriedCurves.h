// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <vector>

namespace hybridtree
{

/// Chains of points of a mesh, by index; closed ones end where they begin.
using PointChains = std::vector<std::vector<std::int32_t>>;

/// What a Boolean leaves of chains that run along edges of an operand: where these edges, or parts
/// of them between points of the cut, are edges of the result.
/// \param chains of points of the operand's mesh, which has `points` of them.
/// \param operand 0 for A, 1 for B. \return chains of points of the result.
PointChains carriedCurves(
  const PointChains& chains, std::size_t points, int operand, const MeshBooleanResult& result);

} // namespace hybridtree
