// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// Whether a mesh is a closed, oriented 2-manifold with normals, so that parts of it can be kept in
/// another mesh. Remembered as long as anyone holds this very mesh object. Thread-safe.
bool isSoundMesh(const MeshPtr& mesh);

} // namespace hybridtree
