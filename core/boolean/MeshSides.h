// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/CutCurves.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// What of each mesh lies outside of the other.
struct MeshSides
{
  /// Per mesh and triangle: bit k where the edge from corner k is crossed, bit 3 (kCut) where the
  /// triangle is cut.
  static constexpr std::uint8_t kCut = 8;
  std::array<std::vector<std::uint8_t>, 2> cut;

  /// Per mesh and vertex: whether it lies outside; kUnused for points without triangles.
  static constexpr std::int8_t kUnused = -1;
  std::array<std::vector<std::int8_t>, 2> outside;

  /// Sides contradict each other: a mesh crosses itself where it meets the other, shells of it
  /// overlap there, or it is inside out. What is cut out along these sides need not be closed.
  bool contradictory = false;
};

/// Sides spread from the crossings along edges that are not crossed; one ray for every part of a
/// mesh that no crossing reaches ([HT] 5.3 asks for the side of each vertex).
MeshSides meshSides(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const CutCurves& curves);

} // namespace hybridtree
