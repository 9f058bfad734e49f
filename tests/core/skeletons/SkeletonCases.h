// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Cone.h"
#include "core/skeletons/ConeSphere.h"
#include "core/skeletons/Cylinder.h"
#include "core/skeletons/Disc.h"
#include "core/skeletons/HollowCylinder.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/Segment.h"
#include "core/skeletons/Spline.h"
#include "tests/support/Random.h"

#include <functional>
#include <string>
#include <vector>

namespace hybridtree::test
{

/// A skeleton beside what is needed to check it without its own code.
struct SkeletonCase
{
  std::string name;
  SkeletonPtr skeleton;
  /// Points of the skeleton, or of the boundary of a volume, and the distance within which each
  /// point of it has one of them.
  std::vector<Vec3> samples;
  double cover = 0.0;
  /// Inside a volume, by definition; null for curves.
  std::function<bool(const Vec3&)> inside;
  /// distanceRange() is exact to second order.
  bool sharpRange = true;
};

/// Random skeletons of every kind, then degenerate ones.
std::vector<SkeletonCase> skeletonCases();

/// Least |p - c| - s over the points c of curves of radius s: by samples, each local minimum of
/// which is refined.
double distanceToSpans(const std::vector<CubicSpan>& spans, const Vec3& p);

/// Points through which the curves of the tests go: a walk of about unit steps.
std::vector<Vec3> randomWalk(Random& random, int count);

/// A rotation or reflection times `scale`, with a translation.
Affine3 randomSimilarity(Random& random, double scale);

/// Any invertible map, its stretches between 0.3 and 3.
Affine3 randomAffine(Random& random);

} // namespace hybridtree::test
