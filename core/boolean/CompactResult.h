// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <vector>

namespace hybridtree
{

/// Drops triangles whose corners are -1 and points that are then of none, with what is told of
/// them; all else keeps its order. Curves of what has gone go, steps without length too.
/// \param becomes per point: the one that it has become, itself where it stays.
void compactResult(MeshBooleanResult& result, const std::vector<std::int32_t>& becomes);

} // namespace hybridtree
