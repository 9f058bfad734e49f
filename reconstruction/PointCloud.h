// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Cleaning and thinning of point sets, on PCL. Each function takes a choice of the points by index
/// and returns those that stay, in the order given, so that whatever belongs to a point can follow.
/// PCL computes in float: it is given points moved and scaled into a box around 0, never the
/// points themselves, and gives back indices.
/// All throw InvalidGeometry for a chosen point that is not finite or an extent that double
/// cannot hold, Cancelled, and
/// InvalidParameter.

/// All points: 0, 1, ...
std::vector<std::int32_t> allPoints(const std::vector<Vec3>& points);

/// Of points with exactly equal coordinates, the first.
std::vector<std::int32_t> withoutDuplicates(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, const Progress& progress = Progress::none());

/// Statistical outlier removal: drops points whose mean distance to their nearest neighbours is
/// more than `deviation` standard deviations above the mean of all points'.
/// \param neighbors >= 1. \param deviation >= 0, in standard deviations.
std::vector<std::int32_t> withoutOutliers(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, int neighbors, double deviation,
  const Progress& progress = Progress::none());

/// A subset of the points, no two of which are closer than `spacing` (up to float rounding), while
/// every point is within `spacing` of one that stays. 0 keeps all.
/// \param spacing world units, finite, >= 0.
std::vector<std::int32_t> thinned(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, double spacing,
  const Progress& progress = Progress::none());

/// Moves chosen points onto a smooth surface among them all: moving least squares (Alexa et al.
/// 2003, in one step). Around each point a plane is fitted to its neighbours, then a quadratic
/// height over it, and the point goes straight onto that. So noise, and several layers of
/// overlapping scans that are less than about half the radius apart, come out as one sheet; detail
/// finer than the radius goes too. Of points closer than an eighth of the radius one stays, so that
/// a large radius takes no longer than a small one.
/// \param radius of the neighbourhood, world units, finite, > 0. Points with fewer than six
/// neighbours in it stay.
/// \param points of which those that stay are moved. \returns these.
std::vector<std::int32_t> smooth(std::vector<Vec3>& points, const std::vector<std::int32_t>& chosen,
  double radius, const Progress& progress = Progress::none());

/// Per chosen point: points per unit area around it, on the assumption that they sample a surface:
/// k / (pi d^2), d the distance to the k-th neighbour. Infinite where k points coincide.
/// \param neighbors k >= 1; fewer when there are fewer points.
std::vector<double> surfaceDensity(const std::vector<Vec3>& points,
  const std::vector<std::int32_t>& chosen, int neighbors,
  const Progress& progress = Progress::none());

/// The `neighbors` nearest of all points to each of them, itself left out, nearest first: point k's
/// at [k * neighbors, (k + 1) * neighbors). \pre 1 <= neighbors < number of points.
std::vector<std::int32_t> nearestNeighbors(
  const std::vector<Vec3>& points, int neighbors, const Progress& progress = Progress::none());

/// Of some points the nearest to a place, and how far off it is.
struct NearestPoint
{
  std::int32_t point = -1;
  double distance = 0.0; ///< world units, up to float rounding of the points' extent
};

/// Per place the nearest of the points. \pre points is not empty.
std::vector<NearestPoint> nearestPoints(const std::vector<Vec3>& points,
  const std::vector<Vec3>& places, const Progress& progress = Progress::none());

} // namespace hybridtree
