// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Blend.h"
#include "core/nodes/Node.h"
#include "tests/support/Random.h"

namespace hybridtree::test
{

/// A tree of every kind of node, of a size around 1, the same for the same seed.
///
/// At most `depth` nodes above each other. Leaves are skeletons and small meshes, some of them
/// carving; the root always has a part that does not.
/// \param blends of all its blends, local ones too; the shape is the same with all.
/// \param deformedEdge edge length of free-form nodes that are meshes afterwards.
NodePtr randomTree(
  std::uint64_t seed, int depth, const BlendOptions& blends = {}, double deformedEdge = 0.15);

/// Rotation, and often a scale, a reflection or a stretch; moves by at most 0.3.
Affine3 randomMap(Random& random);

} // namespace hybridtree::test
