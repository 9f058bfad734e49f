// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

namespace hybridtree
{

/// What a value of the field of a tree costs near its surface: Node::sampleCost() of all its nodes
/// upon each other, where of many children only some reach any one place. The same for the same
/// tree.
double fieldCost(const Node& node, double edgeLength);

} // namespace hybridtree
