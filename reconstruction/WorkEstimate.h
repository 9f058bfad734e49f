// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/LevelOfDetail.h"

#include "core/base/Types.h"

#include <cstddef>

namespace hybridtree
{

/// What a reconstruction will take, told before it starts. Both grow in proportion to the points,
/// and with a level of detail to the vertices, too.
struct WorkEstimate
{
  /// Memory of the process while it works, above what it had, with the empty balls and normals that
  /// are looked at where points are hidden or the surface is open. Within a factor of 3.
  double bytes = 0.0;
  /// On two cores of 2.6 GHz with nothing else to do, within a factor of 2 for all points or a
  /// number of vertices; the order of magnitude elsewhere.
  double seconds = 0.0;
};

/// Of all points.
WorkEstimate estimateWork(std::size_t points);

/// How many tetrahedra fit into so many bytes of memory with all that is made of them.
std::size_t mostTetrahedra(std::size_t bytes);

/// At a level of detail, of so many points within bounds. How many vertices a tolerance needs is
/// known only afterwards: seven for each time that it goes into the diagonal of the points are
/// taken: of scans and samples mostly within a factor of 3.
WorkEstimate estimateWork(std::size_t points, const Box3& bounds, const LevelOfDetail& detail);

} // namespace hybridtree
