// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"
#include "core/boolean/Expansion.h"

#include <array>
#include <cstdint>
#include <functional>

namespace hybridtree
{

/// A vertex of one of two meshes, as predicates see it.
struct Site
{
  Vec3 position;
  std::int32_t index; ///< in its mesh; negative for a point of no mesh
  bool second;        ///< of the second mesh
};

/// Predicates on the vertices of two meshes A and B that never say "on" (simulation of simplicity,
/// Edelsbrunner and Muecke 1990): for an infinitesimal e > 0 a vertex of B stands at
/// b + e n + e^2 g, and one of A at a + e^3 h. Answers are exact, and consistent with each other.
///
/// n is a direction given per vertex: outward normals swell B, so that faces which coincide or
/// touch end up one way, together. g and h are pseudo-random by index: they settle what n leaves
/// open. Both are vectors of integers below 2^21, exact as doubles.
///
/// Each answer is the sign of the first coefficient of a polynomial in e that is not zero: by
/// floating point with an error bound, and where that cannot tell by expansions.
/// Any number of threads may ask.
class PerturbedPredicates
{
public:
  /// n of a vertex of B: integers below 2^21 in size. Asked only in ties.
  using Direction = std::function<Vec3(std::int32_t)>;

  PerturbedPredicates(Direction direction, std::uint64_t seed) : direction_(direction), seed_(seed)
  {
  }

  /// Side of the plane a, b, c on which d lies: 1 on that of the normal (b - a) x (c - a), else -1.
  /// 0 only if d = a, b or c, or all the perturbations fail to tell.
  /// \pre one of the points is of A.
  int side(const Site& a, const Site& b, const Site& c, const Site& d) const;

  /// Which of two triangles the edge from p to q meets first: -1 the first, 1 the second, 0 if the
  /// perturbations fail to tell. \pre it crosses both; all three corners of the triangles are of
  /// the mesh that p and q are not of.
  int order(const Site& p, const Site& q, const std::array<Site, 3>& first,
    const std::array<Site, 3>& second) const;

  /// Where the edge from p to q crosses a triangle: 0 at p, 1 at q. The limit for e to 0, and
  /// exactly 0 or 1 where that is p or q. \pre as order().
  double parameter(const Site& p, const Site& q, const std::array<Site, 3>& triangle) const;

private:
  class Volume;

  const Direction direction_;
  const std::uint64_t seed_;
};

} // namespace hybridtree
