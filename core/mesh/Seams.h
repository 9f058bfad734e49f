// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// How near to each other points of open edges are the same but for rounding: this share of the
/// diagonal of their mesh. Files in text keep six digits; turned profiles miss their start by less.
constexpr double kSeamTolerance = 1e-6;

/// For each point of a mesh the point that it is to be joined with: itself, or for a point on an
/// open edge the first such point within kSeamTolerance. So surfaces close along seams whose two
/// sides were computed one by one. Points off open edges are never joined.
/// Empty where nothing is to be joined. Depends on the order of the points only.
std::vector<std::int32_t> seamPoints(const TriangleMesh& mesh);

} // namespace hybridtree
