// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/skeletons/SkeletonCases.h"

namespace hybridtree::test
{

/// A skeleton of revolution beside its section by the half plane (distance from the axis, height),
/// written down without its code.
struct RoundCase
{
  std::string name;
  SkeletonPtr skeleton;
  Vec3 origin; ///< of heights
  Vec3 axis;   ///< unit
  /// Pieces of the skeleton in the half plane, or of the boundary of a volume; each of [0, 1].
  std::vector<std::function<Eigen::Vector2d(double)>> pieces;
  std::function<bool(double radial, double height)> inside; ///< null for a surface
};

/// Random ones of every kind, then degenerate ones.
std::vector<RoundCase> roundCases();

/// The case with dense samples of the whole skeleton.
SkeletonCase withSamples(const RoundCase& round);

} // namespace hybridtree::test
