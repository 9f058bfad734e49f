// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CutMesh.h"
#include "core/stitch/PatchBricks.h"

#include <unordered_map>
#include <vector>

namespace hybridtree
{

struct LatticeEdge
{
  Index3 low{};
  unsigned axis = 0;

  bool operator==(const LatticeEdge& other) const { return low == other.low && axis == other.axis; }
};

struct LatticeEdgeHash
{
  std::size_t operator()(const LatticeEdge& edge) const
  {
    return 3 * Index3Hash()(edge.low) + edge.axis;
  }
};

/// The vertices of a mesh on the lattice edges along the border of marked cells.
class BorderCrossings
{
public:
  explicit BorderCrossings(const std::vector<BorderCrossing>& crossings);

  /// In rising order along the edge; null where there is none.
  const std::vector<std::int32_t>* find(const LatticeEdge& edge) const;

  /// visit(edge, vertices), in no order.
  template <class Visit>
  void forEach(Visit&& visit) const
  {
    for (const auto& [edge, vertices] : vertices_)
    {
      visit(edge, vertices);
    }
  }

private:
  std::unordered_map<LatticeEdge, std::vector<std::int32_t>, LatticeEdgeHash> vertices_;
};

/// Makes the sides of the corners on the border of the marked cells those that the crossings tell:
/// the side changes at each of them. In every connected part of the border that leaves two
/// possibilities, of which the one is taken that agrees with more samples of the field, at some
/// corners of that part.
/// \return lattice points where the crossings contradict each other; empty for a closed mesh.
/// \throws Cancelled.
std::vector<Index3> alignBorderSigns(
  PatchBricks& bricks, const BorderCrossings& crossings, const Progress& progress);

} // namespace hybridtree
