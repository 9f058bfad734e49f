// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <vector>

namespace hybridtree
{

/// Unit normals of points that sample a surface, all to one side of it (Hoppe et al. 1992): of the
/// plane that fits a point and its neighbours best, turned along the tree of least bends from
/// neighbour to neighbour. To which side is an open question for an open surface: outward from the
/// middle of the points where that tells, else, as of a landscape, up the axis that most look
/// along.
///
/// Good where the surface is smooth at the distance of a few points; at creases and sheets close
/// together the turning may go wrong. Empty for fewer points than a neighbourhood has.
/// Deterministic, for any number of threads. \throws Cancelled, InvalidGeometry for points that are
/// not finite.
std::vector<Vec3> estimateNormals(
  const std::vector<Vec3>& points, const Progress& progress = Progress::none());

} // namespace hybridtree
