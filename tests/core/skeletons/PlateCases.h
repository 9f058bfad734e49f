// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/skeletons/SkeletonCases.h"

#include "core/skeletons/Ellipsoid.h"
#include "core/skeletons/Polygon.h"
#include "core/skeletons/Rectangle.h"
#include "core/skeletons/Triangle.h"

namespace hybridtree::test
{

/// A flat skeleton beside its outline, in order.
struct PlateCase
{
  std::string name;
  SkeletonPtr skeleton;
  std::vector<Vec3> corners;
};

/// Random ones of every kind, convex and not, then degenerate ones.
std::vector<PlateCase> plateCases();

/// The case with dense samples of the whole plate.
SkeletonCase withSamples(const PlateCase& plate);

/// Outlines in the plane z = 0.
std::vector<Vec3> letterL();
std::vector<Vec3> star(int points, double inner, double outer);

/// Whether p, in the plane of the corners, is inside of them: by the angle they turn around it.
bool isInside(const std::vector<Vec3>& corners, const Vec3& p);

/// Random ellipsoids, then round, flat and thin ones.
std::vector<SkeletonCase> ellipsoidCases();

} // namespace hybridtree::test
