// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// Makes a node of the named kind again: the inverse of kind(), parameters() and children().
/// \throws InvalidText for a kind that is not known, and what the kind's maker throws.
NodePtr makeNode(const std::string& kind, const Parameters& parameters,
  const std::vector<NodePtr>& children, const MeshLookup& lookup);

/// All kinds that makeNode() knows.
std::vector<std::string> nodeKinds();

} // namespace hybridtree
