// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

namespace hybridtree
{

/// Fills mesh.sourceLeaf from triangle `first` on with what Node::sourceLeaf() says at the
/// centroids. \throws Cancelled.
void findSourceLeaves(
  const Node& node, TriangleMesh& mesh, std::size_t first, const Progress& progress);

} // namespace hybridtree
