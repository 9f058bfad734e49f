// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// Share of a mesh's area, 0 to 1, that its point normals shade wrongly: in triangles with a corner
/// whose normal is more than `angle` (radians) off their own. At a sharp edge points are shared and
/// have one normal for both sides, so each triangle there is smeared as far as it reaches: little
/// where triangles are small, as on scans, all of a plate whose faces are two triangles.
///
/// 0 without normals. The same bits for any number of threads.
double sharpShare(const TriangleMesh& mesh, double angle = 0.7);

} // namespace hybridtree
