// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"
#include "core/polygonize/Lattice.h"

#include <vector>

namespace hybridtree
{

/// Side of a point, from f - T there. Values that are T up to rounding count as inside, so that a
/// surface in a plane of the lattice is not torn by noise. Not-a-number is outside.
inline bool isInside(double value)
{
  return value >= -1e-12;
}

/// A lattice edge whose ends lie on different sides of the surface.
struct CrossedEdge
{
  Index3 low{};      ///< from this point
  unsigned axis = 0; ///< to the next along this axis
  bool lowInside = false;
  /// f - T at the ends. Not-a-number: not known yet. Only their sizes matter: the sides are given.
  float lowValue = 0.0f;
  float highValue = 0.0f;
};

/// Puts a vertex where each edge meets the surface, all edges in one batch.
///
/// Brackets the crossing and interpolates (Chandrupatla 1997: inverse quadratic steps with
/// bisection where those are not to be trusted). The gradient that gives the normal also gives a
/// last Newton step, so that a smooth field costs one value and one gradient for each vertex. Where
/// the field jumps, the vertex is put at the jump.
///
/// \param source valid at the edges. \param points, normals one for each edge; a normal is 0 where
/// the field does not tell it: where its gradient vanishes, and at jumps. Vertices keep at least
/// 1e-4 cells off the ends of their edge.
void findSurface(const FieldSource& source, const Lattice& lattice, std::vector<CrossedEdge>& edges,
  Vec3* points, Vec3* normals);

} // namespace hybridtree
