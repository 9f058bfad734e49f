// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <vector>

namespace hybridtree
{

/// The mesh leaves of a tree, to say one place on them in terms of another triangle.
class LeafPlaces
{
public:
  /// Trees of very many leaves are not walked: nothing then has a place.
  explicit LeafPlaces(const Node& tree);

  /// Says `origin` by its weights in a triangle of a leaf. False where it does not lie there.
  bool moveTo(std::int32_t leaf, std::int32_t triangle, VertexOrigin& origin) const;

private:
  std::vector<MeshPtr> meshes_; ///< per leaf, null for other kinds
};

} // namespace hybridtree
