// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

struct DelaunayTriangulation; // DelaunayTypes.h

/// \throws InvalidGeometry for a coordinate that is not finite (names the point).
void checkFinite(const std::vector<Vec3>& points);

/// All indices of the points, neighbours in space mostly near each other, the first ones spread
/// over all: the order in which a Delaunay triangulation is built fastest, and in which arrays
/// about the points are read with the fewest cache misses. The same for the same points.
/// \throws InvalidGeometry for a coordinate that is not finite (names the point).
std::vector<std::int32_t> spatialOrder(const std::vector<Vec3>& points);

/// Delaunay tetrahedralization of a point set as plain arrays: what convection walks over.
///
/// Cells 0 .. finiteCells-1 are tetrahedra of positive orientation; those after them are infinite:
/// one per facet of the convex hull, with kInfinite as one of its vertices. Facet i of a cell is
/// the one opposite to its vertex i. Built by CGAL, so exact: no finite cell is flat.
class Tetrahedralization
{
public:
  static constexpr std::int32_t kInfinite = -1;
  using Cell = std::array<std::int32_t, 4>;

  /// \param points must stay alive and unchanged as long as this object; any order will do, but
  /// many are fast in spatialOrder only. Of points that coincide one takes part.
  /// \throws InvalidGeometry for a coordinate that is not finite (names the point), fewer than four
  /// different points, or points that all lie in one plane. \throws Cancelled.
  Tetrahedralization(const std::vector<Vec3>& points, const Progress& progress);
  /// Of a triangulation that exists, whose vertices are numbered as the points. Numbers its cells.
  Tetrahedralization(const std::vector<Vec3>& points, const DelaunayTriangulation& delaunay,
    const Progress& progress);

  /// Corners of facet i of a cell, counter-clockwise seen from outside of the cell.
  static constexpr int kFacetCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

  const std::vector<Vec3>& points() const { return *points_; }
  std::int32_t cellCount() const { return static_cast<std::int32_t>(cells_.size()); }
  std::int32_t finiteCellCount() const { return finiteCells_; }
  bool finite(std::int32_t cell) const { return cell < finiteCells_; }
  const Cell& cell(std::int32_t cell) const { return cells_[cell]; }
  std::int32_t neighbor(std::int32_t cell, int facet) const { return neighbors_[cell][facet]; }
  /// The facet of neighbor(cell, facet) that is the same triangle.
  int mirror(std::int32_t cell, int facet) const;
  /// Where in the cell a vertex is; -1 if nowhere.
  int indexOf(std::int32_t cell, std::int32_t vertex) const;

  /// Corners of a facet of a finite cell, counter-clockwise seen from outside of the cell.
  std::array<std::int32_t, 3> facet(std::int32_t cell, int facet) const;

  /// Whether the half-facet is oriented Gabriel: the half of its diametral ball on the cell's side
  /// holds no point. The balls through a facet's circle grow on one side as they shrink on the
  /// other, and the first point they meet on the cell's side is the cell's fourth vertex, so that
  /// vertex is the only one to test. Exact. \pre the cell is finite.
  bool isOrientedGabriel(std::int32_t cell, int facet) const;

  /// Cells around a vertex, the infinite ones too.
  struct Star
  {
    const std::int32_t* first;
    const std::int32_t* last;
    const std::int32_t* begin() const { return first; }
    const std::int32_t* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
  };
  Star star(std::int32_t vertex) const;

private:
  void copy(const DelaunayTriangulation& delaunay, const Progress& progress);
  void collectStars(const Progress& progress);

  const std::vector<Vec3>* points_;
  std::vector<Cell> cells_;
  std::vector<Cell> neighbors_;
  std::int32_t finiteCells_ = 0;
  std::vector<std::int32_t> starOffset_;
  std::vector<std::int32_t> starCells_;
};

} // namespace hybridtree
