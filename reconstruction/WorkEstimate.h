// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/LevelOfDetail.h"

#include <cstddef>

namespace hybridtree
{

/// What a reconstruction will take, told before it starts. Both grow in proportion to the points,
/// and with a level of detail to the vertices, too.
struct WorkEstimate
{
  /// Memory of the process while it works, above what it had. About a third more than was measured
  /// on surfaces; within a factor of 3.
  double bytes = 0.0;
  /// On two cores of 2.6 GHz with nothing else to do: the order of magnitude elsewhere.
  double seconds = 0.0;
};

/// Of all points.
WorkEstimate estimateWork(std::size_t points);

/// At a level of detail. How many vertices a tolerance needs is known only afterwards: a fourth of
/// the points is taken, which is more than most need.
WorkEstimate estimateWork(std::size_t points, const LevelOfDetail& detail);

} // namespace hybridtree
