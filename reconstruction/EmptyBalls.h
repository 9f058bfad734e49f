// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/SignedHarmonic.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// The empty balls around the tetrahedra of a Delaunay tetrahedralization, and half-spaces before
/// the facets of its hull. Of tetrahedra whose points lie in a plane face, as far as double can
/// tell, it is a half-space, too. Threads may share it.
class EmptyBalls
{
public:
  /// \param tetrahedra must stay alive. \throws Cancelled.
  EmptyBalls(const Tetrahedralization& tetrahedra, const Progress& progress);

  /// Whether it is a half-space. It then lies before the hull.
  bool isHalfSpace(std::int32_t cell) const { return balls_[cell].radius == 0.0; }
  /// World units; of half-spaces 0.
  double diameter(std::int32_t cell) const { return 2.0 * balls_[cell].radius; }
  /// From a point on its sphere to its centre, of length 1; of half-spaces the way out.
  Vec3 way(std::int32_t point, std::int32_t cell) const
  {
    const Ball& ball = balls_[cell];
    return ball.radius > 0.0 ? Vec3((ball.center - tetrahedra_.points()[point]) / ball.radius)
                             : ball.center;
  }

  /// How much two balls on the sphere of each of which a point lies are one, 1 down to some 0.0003
  /// where they only touch, by the angle between the ways to their centres; and, negated, how much
  /// two are opposite. (Kolluri, Shewchuk and O'Brien 2004.)
  static float weight(double cosine)
  {
    constexpr double kSharpness = 4.0;
    return static_cast<float>(std::exp(kSharpness * (cosine - 1.0)));
  }

private:
  struct Ball
  {
    Vec3 center;   // of half-spaces the way out
    double radius; // of half-spaces 0
  };

  Ball ballOf(std::int32_t cell, double huge) const;
  Ball halfSpace(std::int32_t cell) const;

  const Tetrahedralization& tetrahedra_;
  Vec3 middle_; // within the hull
  std::vector<Ball> balls_;
};

/// Links of cells with a common facet, those before the hull too, by EmptyBalls::weight.
/// \throws Cancelled.
std::vector<SignedLink> linksOfNeighbors(
  const Tetrahedralization& tetrahedra, const EmptyBalls& balls, const Progress& progress);

} // namespace hybridtree
