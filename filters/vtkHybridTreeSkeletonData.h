// SPDX-License-Identifier: BSD-3-Clause
// Private: skeleton graphs across the border between VTK and the core.
#ifndef vtkHybridTreeSkeletonData_h
#define vtkHybridTreeSkeletonData_h

#include "core/subdivision/SkeletonGraph.h"
#include "core/subdivision/Subdivide.h"

#include <string>

class vtkPolyData;

namespace hybridtree
{

/// Lines and polylines of a polydata as segments, polygons and strips as triangles; points at
/// exactly the same place become one, so that pieces appended to each other hang together.
/// Vertices, and points without a cell, do not count.
/// \param radiusArray point array of one component with the radii. "Automatic": Radius, if it is
/// there. "None", empty, or Automatic without one: `radius` everywhere, and for 0 a share of 0.03 of
/// the longest side of the skeleton's bounds. Of points that become one the first gives the radius.
/// \throws InvalidParameter for an array that is not there; InvalidGeometry where there are neither
/// lines nor polygons, for points that are not finite, and as validate().
SkeletonGraph toSkeleton(vtkPolyData* input, const std::string& radiusArray, double radius);

///@{
/// Points, lines, triangles, and the point array Radius; of a refined skeleton the cell array
/// CoarseElement, too, with the segment or, from the number of coarse segments on, the triangle
/// that a cell comes from.
void toPolyData(const SkeletonGraph& graph, vtkPolyData* output);
void toPolyData(const RefinedSkeleton& skeleton, std::size_t coarseSegments, vtkPolyData* output);
///@}

/// \throws InvalidParameter for a number that is no scheme.
SubdivisionScheme toScheme(int scheme);

} // namespace hybridtree

#endif
