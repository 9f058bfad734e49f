// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// Moves some points of a mesh, that lie near f = T, onto it: by Newton steps, and where those do
/// not settle, as at creases, along the point's normal to where the side changes. Those that are
/// moved by Newton steps get normals -grad f / |grad f|. A point farther off than `reach`, or
/// twice that along its normal, stays.
/// \return for each of the points 1, or 0 if it stays.
std::vector<char> projectPoints(const FieldSource& field, const std::vector<std::size_t>& points,
  double reach, TriangleMesh& mesh);

} // namespace hybridtree
