// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CGAL's triangulation as this room uses it. Takes long to compile: for source files only.

#include "core/base/Types.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cstdint>

namespace hybridtree
{

struct CellInfo
{
  std::int32_t number = -1;
  bool inside = false; // of the surface, where there is one
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>,
    CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel,
      CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;

// A type of its own, to be declared where CGAL's headers are not.
struct DelaunayTriangulation : Delaunay
{
};

inline Kernel::Point_3 toCgal(const Vec3& p)
{
  return { p.x(), p.y(), p.z() };
}

} // namespace hybridtree
