// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"
#include "core/polygonize/Lattice.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// A square of a lattice with two corners inside that lie across its diagonal, so that the corners
/// do not tell whether these two or the other two are joined within the face.
struct AmbiguousFace
{
  Index3 low{};           ///< lowest corner
  unsigned axis = 0;      ///< across the face; it reaches from `low` along the other two
  bool lowInside = false; ///< and so is the corner across
};

/// 1 for each face in which the two inside corners are joined.
///
/// By the contours of f = T on a finer grid in the face, where values between the grid's points are
/// bilinear: of two diagonal corners either the inside ones or the other ones are joined, never
/// both and never neither. What is thinner than about a quarter of the face may be missed. \param
/// field valid in a box with all faces.
std::vector<std::uint8_t> joinsInside(
  const FieldSource& field, const Lattice& lattice, const std::vector<AmbiguousFace>& faces);

} // namespace hybridtree
