// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// N corners, of 2 that of a segment, of 3 that of a triangle.
template <std::size_t N>
struct GroupedElement
{
  std::array<std::int32_t, N> corners; ///< indices of points
  std::array<double, N> reaches;       ///< R at the corners, as the field takes it
  std::int32_t group;
};

/// Segments and triangles that share points. The children of one coarse element are a group.
struct GroupedElements
{
  std::vector<Vec3> points;
  std::vector<double> reaches; ///< R, one per point
  std::vector<GroupedElement<2>> segments;
  std::vector<GroupedElement<3>> triangles;
  /// Per group: the coarse points of its coarse element; -1 as third for a segment.
  std::vector<std::array<std::int32_t, 3>> groups;
};

} // namespace hybridtree
