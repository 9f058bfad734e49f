// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"

#include "core/base/Progress.h"

#include <vector>

namespace hybridtree
{

/// Takes the triangles out of a surface that span holes of the sampling, so that these are left
/// open: those with a place on them that is farther from every input point than half of `factor`
/// local spacings. The spacing at a point is 1/sqrt(points per unit area) around it
/// (surfaceDensity of PointCloud.h), so no triangle of points drawn at random over a surface is
/// taken for a hole: an empty disc of the default size comes once in 3e8.
/// What then hangs by a single point is cut off there (the smaller part goes, where it has no other
/// hold), and so are pieces of fewer than a hundredth of the triangles of the largest: the result
/// is an oriented manifold with boundary. \param surface of which the triangles, points, normals
/// and pointIds become fewer. \param points all of the input, also those that are no vertices.
/// \param factor no unit, >= 1.
/// \throws InvalidParameter, also if nothing would be left. \throws InvalidGeometry where a few
/// points are some 1e6 spacings from the others. \throws Cancelled.
/// \returns how many triangles were taken out.
std::size_t openHoles(ReconstructedSurface& surface, const std::vector<Vec3>& points, double factor,
  const Progress& progress = Progress::none());

/// \throws InvalidParameter for a factor that openHoles() would refuse.
void checkHoleFactor(double factor);

} // namespace hybridtree
