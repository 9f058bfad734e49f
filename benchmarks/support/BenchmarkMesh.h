// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <string>

namespace hybridtree::benchmark
{

/// A scan from the data folder (.obj or .ply as they lie there), repaired and scaled into the unit
/// box as in [HT] Fig. 7. Where the folder is absent: a bumpy sphere of about `triangles`
/// triangles, and a line on stderr that says so.
MeshPtr benchmarkMesh(const std::string& file, std::size_t triangles);

} // namespace hybridtree::benchmark
