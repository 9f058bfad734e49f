// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionField.h"

#include <vector>

namespace hybridtree
{

/// What the field in a box is made of.
struct BlendSelection
{
  /// A group, or several that blend fully with whatever is in reach: elements in a row of `all`,
  /// from where those of the unit before end.
  struct Unit
  {
    std::size_t segmentsEnd;
    std::size_t trianglesEnd;
  };
  struct Group
  {
    std::int32_t group;
    std::size_t unit;
  };

  ElementSelection all; ///< all elements that reach the box
  /// Not everything adds up. Without units nothing more is known.
  bool isControlled = false;
  std::vector<Unit> units;
  std::vector<Group> groups; ///< that reach the box, with their units
  bool hasRest;              ///< unit 0 is not a single group: it is apart from none
  /// Row by row of units x units: how far places on the first that reach the second are from it at
  /// most; for the rest, places on any of its groups or the distance from any.
  std::vector<double> farthest;
  std::vector<char> areUnjoined; ///< the same, symmetric: no sum has both, and they meet

  bool empty() const { return all.empty(); }
  ElementSpans elementsOf(std::size_t unit) const
  {
    const Unit first = unit == 0 ? Unit{ 0, 0 } : units[unit - 1];
    return {
      { all.segments.data() + first.segmentsEnd, units[unit].segmentsEnd - first.segmentsEnd },
      { all.triangles.data() + first.trianglesEnd, units[unit].trianglesEnd - first.trianglesEnd }
    };
  }
};

} // namespace hybridtree
