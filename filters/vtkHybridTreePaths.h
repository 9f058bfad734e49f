// SPDX-License-Identifier: BSD-3-Clause
// Private: what the lines of a polydata draw, be they whole polylines or pieces that share points,
// as a slice has them.
#ifndef vtkHybridTreePaths_h
#define vtkHybridTreePaths_h

#include "core/base/Types.h"
#include "vtkType.h"

#include <vector>

class vtkPolyData;

namespace hybridtree
{

/// Points in order; of a closed one the first is not repeated.
struct Path
{
  std::vector<vtkIdType> points;
  bool closed = false;
};

/// Lines joined end to end as long as there are more, each in one path, in the order of the paths'
/// first lines. Where more than two meet any of them goes on.
std::vector<Path> pathsOf(vtkPolyData* input);

/// Polygons as closed paths.
std::vector<Path> polygonsOf(vtkPolyData* input);

/// Where the points are. \throws InvalidGeometry, naming the first that is not finite.
std::vector<Vec3> placesOf(const Path& path, vtkPolyData* input);

} // namespace hybridtree

#endif
