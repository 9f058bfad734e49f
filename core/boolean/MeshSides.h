// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/CutCurves.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace hybridtree
{

/// How often each mesh goes around the vertices of the other.
struct MeshSides
{
  /// Per mesh and triangle: bit k where the edge from corner k is crossed, bit 3 (kCut) where the
  /// triangle is cut.
  static constexpr std::uint8_t kCut = 8;
  std::array<std::vector<std::uint8_t>, 2> cut;

  /// Per mesh and vertex: the winding number of the other mesh, 0 outside and 1 inside; others
  /// where that one crosses itself. kUnused for points without triangles.
  static constexpr std::int8_t kUnused = std::numeric_limits<std::int8_t>::min();
  std::array<std::vector<std::int8_t>, 2> winding;

  /// A mesh crosses itself where it meets the other, shells of it overlap there, or it is inside
  /// out, and by more than the tolerance: what is inside of it cannot be told.
  bool contradictory = false;
};

/// One ray for every connected part of a mesh; from there along edges, by one up or down at each
/// crossing.
/// \param tolerance a length: a mesh may cross itself by so much.
MeshSides meshSides(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const CutCurves& curves, double tolerance);

} // namespace hybridtree
