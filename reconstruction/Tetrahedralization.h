// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Delaunay.h"
#include "reconstruction/RawVector.h"

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hybridtree
{

/// Delaunay tetrahedralization of a point set that stands still: what convection walks over.
///
/// Cells 0 .. finiteCells-1 are tetrahedra of positive orientation; those after them are infinite:
/// one per facet of the convex hull, with kInfinite as one of their vertices. Facet i of a cell is
/// the one opposite to its vertex i. No finite cell is flat. Both kinds are in the order of their
/// lowest vertices, so points in spatialOrder make walks over the cells stay near in memory, too.
class Tetrahedralization
{
public:
  static constexpr std::int32_t kInfinite = Delaunay::kInfinite;
  using Cell = std::array<std::int32_t, 4>;

  /// \param points must stay alive and unchanged as long as this object; any order will do, but
  /// many are fast in spatialOrder only. Of points that coincide one takes part.
  /// \throws InvalidGeometry for a coordinate that is not finite (names the point), fewer than four
  /// different points, or points that all lie in one plane. \throws Cancelled.
  /// \throws TooLarge for more tetrahedra than mostCells, while they are made.
  Tetrahedralization(const std::vector<Vec3>& points, const Progress& progress,
    std::size_t mostCells = std::numeric_limits<std::size_t>::max());
  /// Copies one that exists, and keeps its points in sight: they must stay as they are.
  Tetrahedralization(const Delaunay& delaunay, const Progress& progress);

  const std::vector<Vec3>& points() const { return *points_; }
  std::int32_t cellCount() const { return static_cast<std::int32_t>(cells_.size()); }
  std::int32_t finiteCellCount() const { return finiteCells_; }
  bool finite(std::int32_t cell) const { return cell < finiteCells_; }
  const Cell& cell(std::int32_t cell) const { return cells_[cell].vertices; }
  std::int32_t neighbor(std::int32_t cell, int facet) const
  {
    return cells_[cell].beyond[facet] >> 2;
  }
  /// The facet of neighbor(cell, facet) that is the same triangle.
  int mirror(std::int32_t cell, int facet) const { return cells_[cell].beyond[facet] & 3; }
  /// All cells, as Delaunay::renumber() takes them.
  const RawVector<Delaunay::Cell>& cells() const { return cells_; }
  /// For loops that know which cells they come to: reads one ahead.
  void prefetch(std::int32_t cell) const
  {
#if defined(__GNUC__)
    __builtin_prefetch(&cells_[cell]);
#endif
  }
  /// Where in the cell a vertex is; -1 if nowhere.
  int indexOf(std::int32_t cell, std::int32_t vertex) const
  {
    const Cell& v = this->cell(cell);
    return v[0] == vertex ? 0 : v[1] == vertex ? 1 : v[2] == vertex ? 2 : v[3] == vertex ? 3 : -1;
  }

  /// Corners of a facet of a finite cell, counter-clockwise seen from outside of the cell.
  std::array<std::int32_t, 3> facet(std::int32_t cell, int facet) const
  {
    const Cell& v = this->cell(cell);
    const int* corner = Delaunay::kFacetCorners[facet];
    return { v[corner[0]], v[corner[1]], v[corner[2]] };
  }

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
  RawVector<std::int32_t> sort(
    const Delaunay& delaunay, std::vector<std::int32_t>& number, const Progress& progress);
  void copy(const Delaunay& delaunay, const Progress& progress);
  void collectStars(const Progress& progress);

  const std::vector<Vec3>* points_;
  RawVector<Delaunay::Cell> cells_; // vertices and neighbours in one line of the cache
  std::int32_t finiteCells_ = 0;
  std::vector<std::int32_t> starOffset_;
  RawVector<std::int32_t> starCells_;
};

} // namespace hybridtree
