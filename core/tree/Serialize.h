// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/NodeMaker.h"

#include <string>
#include <utility>
#include <vector>

namespace hybridtree
{

/// The tree as JSON text:
///
///   { "format": "HybridTree", "version": 1, "nodes": [
///       { "kind": "primitive", "parameters": { "exponent": 2, ... } },
///       { "kind": "blend", "parameters": { ... }, "children": [0, 0] } ] }
///
/// A node stands behind its children and names them by their index; the last is the root. A subtree
/// used twice is written once and shared again after reading. Numbers come back bit for bit. Meshes
/// of mesh leaves are not in the text, only their content hashes: see meshesOf().
std::string toText(const Node& root);

/// The tree that toText() wrote: same field, bit for bit.
/// \param lookup gives the meshes of mesh leaves by hash; may be empty when there are none.
/// \throws InvalidText for text that is no tree, naming the place: not JSON, of another format or a
/// newer version, an unknown kind, a parameter that is absent or not allowed, a mesh that lookup
/// does not have, more than 1000 nodes above each other or a million leaves.
NodePtr fromText(const std::string& text, const MeshLookup& lookup = {});

/// Content hashes and meshes of the mesh leaves, each once, in depth-first order.
std::vector<std::pair<std::string, MeshPtr>> meshesOf(const Node& root);

} // namespace hybridtree
