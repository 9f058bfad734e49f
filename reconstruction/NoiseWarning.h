// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"

#include <vector>

namespace hybridtree
{

/// Warns where a tenth of the points and more is left out, on both sides of a surface: it runs
/// through a layer of noise, or parts are finer than the points are far apart. The warning names
/// the properties that help, with values: a SmoothingRadius of four times the median distance of
/// what is left out, but of two to five distances between points; and RemoveOutliers if more than
/// one point of a hundred is farther off than that.
/// \param points of which the surface goes through surface.pointIds. Looks at some 2000 of the
/// others.
void warnOfNoise(const std::vector<Vec3>& points, ReconstructedSurface& surface);

} // namespace hybridtree
