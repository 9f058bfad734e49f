// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parameters.h"
#include "core/mesh/TriangleMesh.h"
#include "core/nodes/Node.h"

#include <functional>
#include <string>
#include <vector>

namespace hybridtree
{

/// Gives the mesh of a mesh leaf by its content hash (the text of a tree holds no meshes); null
/// when there is none of that hash.
using MeshLookup = std::function<MeshPtr(const std::string& hash)>;

/// Makes a node again from what Node::parameters() and Node::children() said of it. One per kind,
/// named <kind>FromParameters, beside the kind's public constructor; core/tree/NodeFactory.cpp
/// lists them by Node::kind(). \throws InvalidText for a parameter that is absent or of another
/// type, or a number of children that does not fit; InvalidParameter for a value outside its range.
using NodeMaker = NodePtr (*)(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

/// For makers. \throws InvalidText unless there are `count` children.
void requireChildren(const char* kind, const std::vector<NodePtr>& children, std::size_t count);

} // namespace hybridtree
