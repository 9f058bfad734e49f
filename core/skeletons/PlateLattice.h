// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/PlanarTriangulation.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// The points of a triangular lattice that are inside of an outline and not close to it, in rows
/// along x; the lattice has a point or the middle of an edge in the middle of the outline's bounds.
///
/// Places are in half steps: the point at column X of row Y is X spacing / 2 to the right of that
/// middle and Y rows above it, X + Y even; its neighbours are at (X +- 2, Y) and (X +- 1, Y +- 1).
class PlateLattice
{
public:
  /// Points X = first, first + 2, ..., last of row Y, numbered on from `number`.
  struct Run
  {
    int y, first, last;
    std::int32_t number;
  };

  /// \param margin least distance of a point from the outline.
  /// \pre corners are as PlanarTriangulation has them; spacing > 0.
  PlateLattice(const std::vector<Vec2>& corners, double spacing, double margin);

  /// By y, then by `first`.
  const std::vector<Run>& runs() const { return runs_; }
  /// Runs of row y are runs()[firstOfRow(y)] to runs()[firstOfRow(y + 1)], for y in [-rows(),
  /// rows()].
  int firstOfRow(int y) const { return firstOfRow_[static_cast<std::size_t>(y + rows_)]; }
  int rows() const { return rows_; }
  /// Number of points.
  std::int32_t size() const { return size_; }
  Vec2 place(int x, int y) const
  {
    return { middle_.x() + 0.5 * spacing_ * x, middle_.y() + height_ * y };
  }
  /// The number of the point at a place; -1 where there is none.
  std::int32_t numberAt(int x, int y) const;

private:
  void addRow(const std::vector<Vec2>& corners, double margin, int y);

  double spacing_;
  double height_; // of a row
  Vec2 middle_;
  int rows_; // on either side of the middle
  std::vector<Run> runs_;
  std::vector<int> firstOfRow_;
  std::int32_t size_ = 0;
};

} // namespace hybridtree
