// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// Which triangles of an operand are parts of one plane: those of the same number >= 0. Empty where
/// each triangle is one of its own.
struct Facets
{
  std::vector<std::int32_t> of; ///< per triangle; -1 for one that is not to be touched
  std::int32_t count = 0;       ///< above all numbers

  std::int32_t at(std::int32_t triangle) const
  {
    return of.empty() ? triangle : of[std::size_t(triangle)];
  }
};

/// Those of a result: what is left of a facet of an operand is one. \param triangles per operand.
Facets facetsOf(const MeshBooleanResult& result, const std::array<Facets, 2>& operands,
  const std::array<std::size_t, 2>& triangles);

/// Triangulates facets that a Boolean has cut afresh from their borders: of cut triangles that are
/// cut again and again, what is left of each would become ever more and ever thinner triangles.
///
/// Points inside of a facet go, and those on the straight border between two; then edges within a
/// facet are flipped to Delaunay. Only facets with triangles at the cut change, and only if they
/// consist of parts of several triangles or lose a point; all others stay bit for bit. A facet that
/// is not flat but for rounding is left alone, and a point or an edge where nothing else would do
/// than a triangle without height. The surface stays a closed manifold and moves by no more than
/// rounding: one edge or point after the other goes (Dey et al. 1999).
void mergeFacets(MeshBooleanResult& result, const Facets& facets);

} // namespace hybridtree
