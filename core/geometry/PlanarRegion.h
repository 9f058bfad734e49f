// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"

#include <vector>

namespace hybridtree
{

/// What planar cubics enclose, in the plane of the first two coordinates: a point is inside when a
/// ray along the first axis crosses them an odd number of times. Spans that follow each other share
/// their ends bit for bit; chains may be closed by lines along the first axis, which no ray counts,
/// or by one on the side where rays come from.
class PlanarRegion
{
public:
  PlanarRegion() = default;
  explicit PlanarRegion(const std::vector<CubicSpan>& spans);

  bool contains(double x, double y) const;

private:
  // A part of a cubic along which y changes in one direction.
  struct Piece
  {
    double from; // parameters
    double to;
    double yFrom;
    double yTo;
    double xMin;
    double xMax;
    std::size_t span;
  };

  bool crossesBeyond(const Piece& piece, double x, double y) const;

  std::vector<CubicSpan> spans_;
  std::vector<Piece> pieces_;
};

} // namespace hybridtree
