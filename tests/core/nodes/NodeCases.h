// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <ostream>
#include <string>
#include <vector>

namespace hybridtree::test
{

/// One node that has to keep the contract of Node, of a size around 1.
struct NodeCase
{
  std::string name;
  NodePtr node;
  /// Where a mesh is not made from the field itself: how far its vertices may be from f = T, in
  /// edge lengths.
  double vertexTolerance = 1e-3;
};

/// Every kind of node, each in several configurations. To add a kind, add cases here.
std::vector<NodeCase> nodeCases();

inline std::ostream& operator<<(std::ostream& stream, const NodeCase& testCase)
{
  return stream << testCase.name;
}

} // namespace hybridtree::test
