// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LeafPlace.h"

#include <array>

namespace hybridtree
{
namespace
{

constexpr int kMostLeaves = 10000;

void gather(const Node& node, std::vector<MeshPtr>& meshes)
{
  const std::vector<NodePtr> children = node.children();
  if (children.empty())
  {
    meshes.insert(meshes.end(), static_cast<std::size_t>(node.leafCount()), node.leafMesh());
  }
  for (const NodePtr& child : children)
  {
    gather(*child, meshes);
  }
}

} // namespace

LeafPlaces::LeafPlaces(const Node& tree)
{
  if (tree.leafCount() <= kMostLeaves)
  {
    gather(tree, meshes_);
  }
}

bool LeafPlaces::moveTo(std::int32_t leaf, std::int32_t triangle, VertexOrigin& origin) const
{
  if (origin.leaf != leaf || origin.triangle < 0)
  {
    return false;
  }
  if (origin.triangle == triangle)
  {
    return true;
  }
  if (leaf < 0 || std::size_t(leaf) >= meshes_.size() || !meshes_[std::size_t(leaf)])
  {
    return false;
  }
  const std::vector<Triangle>& triangles = meshes_[std::size_t(leaf)]->triangles;
  const Triangle& from = triangles[std::size_t(origin.triangle)];
  const Triangle& to = triangles[std::size_t(triangle)];
  const std::array<double, 3> weights = { 1.0 - origin.u - origin.v, origin.u, origin.v };
  std::array<double, 3> moved{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::size_t corner = 0;
    while (corner < 3 && to[corner] != from[k])
    {
      ++corner;
    }
    if (corner == 3 && weights[k] != 0.0)
    {
      return false;
    }
    if (corner < 3)
    {
      moved[corner] = weights[k];
    }
  }
  origin = { leaf, triangle, moved[1], moved[2] };
  return true;
}

} // namespace hybridtree
