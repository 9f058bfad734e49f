// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/RawVector.h"

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Delaunay tetrahedralization of a growing point set, in plain arrays: Bowyer 1981 and Watson 1981
/// with exact predicates.
///
/// Space outside of the convex hull is filled by infinite cells, one per facet of the hull, with
/// kInfinite as one of their vertices. Facet i of a cell is the one opposite to its vertex i. A
/// half-facet, 4 * cell + facet, is a facet as seen from one of its two cells.
///
/// A point is inserted where balls around tetrahedra hold it strictly. Of points on one sphere any
/// Delaunay tetrahedralization comes out, the same one for the same points in the same order; no
/// finite cell is ever flat. Not for several threads at once.
class Delaunay
{
public:
  static constexpr std::int32_t kInfinite = -1;
  /// Corners of facet i of a cell, counter-clockwise seen from outside of the cell.
  static constexpr int kFacetCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

  struct Cell
  {
    std::array<std::int32_t, 4> vertices; // points; the first is kUnused in cells not in use
    std::array<std::int32_t, 4> beyond;   // per facet, the half-facet on its other side
  };

  /// What a point would take the place of. Filled by findCavity; may be used over and over.
  struct Cavity
  {
    std::vector<std::int32_t> cells;  // whose balls hold the point
    std::vector<std::int32_t> border; // half-facets of those cells that bound them
  };

  /// Who inserts points one after the other, with what that takes. Several at a time have a slab of
  /// space each. A cell belongs to a slab if all its finite vertices do; those that belong to none
  /// stay as they are meanwhile, and nobody looks at others' cells. So they need no locks, and what
  /// comes out does not depend on who is first.
  class Worker
  {
  public:
    int slab() const { return slab_; }

  private:
    friend class Delaunay;
    std::size_t cellsLeft() const
    {
      return unused.size() + static_cast<std::size_t>(endCell - nextCell);
    }
    struct Base
    {
      std::array<std::int32_t, 3> corners;
      std::int32_t outer;                // half-facet
      std::array<std::int32_t, 3> local; // of the corners
    };
    int slab_ = 0;                    // from 1 on; 0: all space is its own
    std::int32_t nextCell = 0;        // new ones are made from here ...
    std::int32_t endCell = 0;         // ... to here
    std::vector<std::int32_t> unused; // cells given up
    std::uint32_t turn = 1;           // of the walk: where it looks first
    // Scratch of one insertion.
    Cavity cavity;
    std::vector<std::int32_t> marked;
    std::vector<Base> bases;
    std::vector<std::int32_t> locals;
    std::int32_t infiniteLocal = 0;
    std::vector<std::int32_t> edges; // half-facets by pairs of locals
  };

  /// Of a point: a cell that holds it; the vertex that it coincides with, else -1.
  struct Place
  {
    std::int32_t cell;
    std::int32_t vertex;
  };

  /// Appends points and inserts them; those that coincide with others stay without cells. As long
  /// as all lie in one plane, none is inserted. Fastest where neighbours follow each other
  /// (SpatialOrder.h). Many are inserted in parallel; the result is the same, to the numbers of the
  /// cells, for any number of threads. \pre finite. \throws Cancelled, TooLarge.
  void insert(const std::vector<Vec3>& points, const Progress& progress);

  /// From here on more tetrahedra than this are too many; at most 2^29 can be counted. Points of a
  /// surface have 7 each, those along curves each as many as there are points.
  void limitCells(std::size_t most) { mostCells_ = std::min(most, kMostCells); }

  const std::vector<Vec3>& points() const { return points_; }
  bool spansVolume() const { return !cells_.empty(); }
  /// Why spansVolume() does not hold. \throws InvalidGeometry.
  void checkVolume() const;

  /// All cells ever made; those not in use have no vertices.
  std::int32_t cellCount() const { return static_cast<std::int32_t>(cells_.size()); }
  const Cell& cell(std::int32_t cell) const { return cells_[cell]; }
  bool used(std::int32_t cell) const { return cells_[cell].vertices[0] >= kInfinite; }
  bool finite(std::int32_t cell) const
  {
    const auto& v = cells_[cell].vertices;
    return v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && v[3] >= 0;
  }
  std::array<std::int32_t, 3> facet(std::int32_t halfFacet) const
  {
    const auto& v = cells_[halfFacet >> 2].vertices;
    const int* corner = kFacetCorners[halfFacet & 3];
    return { v[corner[0]], v[corner[1]], v[corner[2]] };
  }
  std::int32_t beyond(std::int32_t halfFacet) const
  {
    return cells_[halfFacet >> 2].beyond[halfFacet & 3];
  }
  /// Puts the same cells in another order, so that what is near is near in memory. Numbers of cells
  /// from before have no meaning any more. \param cells all that are used.
  void renumber(const RawVector<Cell>& cells);
  /// A cell around a vertex; -1 where the point is not inserted.
  std::int32_t cellOf(std::int32_t vertex) const { return cellOf_[vertex]; }

  /// All cells around a vertex that has one.
  void star(std::int32_t vertex, std::vector<std::int32_t>& cells);

  /// The rest serves who looks at what an insertion would change, and then decides.
  /// \pre spansVolume(); the place found is the point's; nothing is inserted in between.
  /// \param start a cell from which to walk to the point.
  Place locate(const Vec3& point, std::int32_t start);
  /// Whether the ball around a cell holds a point, which then coincides with no vertex: a place as
  /// good as that of locate().
  bool holds(std::int32_t cell, const Vec3& point) const
  {
    return this->inConflict(cells_[cell], point);
  }
  /// \pre the point coincides with no vertex.
  void findCavity(const Vec3& point, const Place& place, Cavity& cavity);
  /// Inserts the point of the last findCavity. \returns its vertex.
  /// cavity.cells is then the new cells: the k-th has the point as its vertex 0, and the k-th facet
  /// of cavity.border as its facet 0.
  std::int32_t fill(const Vec3& point, Cavity& cavity);

  /// A cell of a cavity, as it was before it was filled.
  struct Replaced
  {
    std::int32_t number;
    Cell cell;
  };
  /// Undoes the insertion of a vertex, and forgets those of higher numbers, which have no cells.
  /// \pre it was made by fill(), and replaced these cells, of which none has changed since but
  /// back. \param star the cells around the vertex.
  void takeBack(std::int32_t vertex, const std::vector<std::int32_t>& star, const Replaced* begin,
    const Replaced* end);

  /// The same by several threads at a time, each with a worker of its own. Until join(), the
  /// functions above may be called while no worker is at work, but for takeBack() and renumber().
  /// \param points where they will insert: as many in each slab.
  /// \param side across which of the sides of the box of all points, 0 the longest.
  std::vector<Worker> part(const std::vector<Vec3>& points, int side);
  /// Slab of a facet all of whose vertices are in it; 0: of several.
  int slabOf(std::int32_t halfFacet) const;
  /// Numbers, and cells, for so many more vertices of the worker's. \returns the first of them, to
  /// be taken in order. Those that stay without cells are points all the same.
  std::int32_t provide(Worker& worker, std::size_t vertices);
  /// cell is -1, and false comes back and nothing is done, where others' space begins.
  /// \param start a cell with a vertex of the worker's slab.
  Place locate(Worker& worker, const Vec3& point, std::int32_t start) const;
  bool findCavity(Worker& worker, const Vec3& point, const Place& place, Cavity& cavity);
  /// Whether what was provided is enough to fill it.
  bool hasCells(const Worker& worker, const Cavity& cavity) const;
  void fill(Worker& worker, std::int32_t vertex, const Vec3& point, Cavity& cavity);
  void join(std::vector<Worker>& workers);

  /// Leaves out points that have no cells, and closes the gaps in their numbers.
  /// \param kept per point; 1 for those with cells.
  void removePoints(const std::vector<std::uint8_t>& kept);

private:
  static constexpr std::int32_t kUnused = -2;
  static constexpr std::int32_t kGiven = -3; // the same, and listed by a worker
  // Of a mark, what is left when divided by kMarks; the quotient is the slab of the cell.
  static constexpr int kMarks = 4;
  static constexpr std::uint8_t kFlags = kMarks - 1;
  static constexpr std::uint8_t kInCavity = 1;
  static constexpr std::uint8_t kOutside = 2;
  static constexpr int kNoSlab = 63;
  // Tetrahedra about a point of a surface, with the infinite ones, and some to spare.
  static constexpr std::size_t kCellsPerPoint = 7;
  static constexpr std::size_t kMostCells = std::size_t(1) << 29; // half-facets are 32-bit numbers
  using Order = std::vector<std::int32_t>;                        // points

  bool insertFirst();
  std::array<std::int32_t, 4> independent() const;
  Order insertMost(const Order& order, const Progress& progress);
  Order insertInSlabs(const Order& order, int axis, const Progress& progress);
  std::array<int, 3> axesBySize() const;
  std::vector<Worker> makeSlabs(int axis, std::vector<double> places, const Progress& progress);
  void markSlab(std::int32_t cell);
  int slabOf(const Vec3& point) const;
  void reuseCells(Worker& worker, std::size_t points);
  void provideCells(Worker& worker, std::size_t points);
  void giveUpRest(Worker& worker);
  std::int32_t startOf(const Worker& worker) const;
  Order insertAll(Worker& worker, const Order& order, const Progress& progress);
  bool insertPoint(Worker& worker, std::int32_t point, std::int32_t& near);

  bool belongs(const Worker& worker, std::int32_t cell) const
  {
    return worker.slab_ == 0 || marks_[cell] / kMarks == worker.slab_;
  }
  bool mayCross(const Worker& worker, std::int32_t halfFacet) const;
  std::int32_t startOfWalk(std::int32_t near) const;
  std::int32_t walk(Worker& worker, const Vec3& point, std::int32_t cell) const;
  Place placeIn(std::int32_t cell, const Vec3& point) const;
  bool inConflict(const Cell& cell, const Vec3& point) const;
  bool findCavity(Worker& worker, const Vec3& point, std::int32_t start, Cavity& cavity);
  void unmark(const std::vector<std::int32_t>& cells);
  void fill(Worker& worker, std::int32_t point, Cavity& cavity);
  void takeCells(Worker& worker, Cavity& cavity);
  std::int32_t localOf(Worker& worker, std::int32_t vertex);
  void makeCells(Worker& worker, std::int32_t point, Cavity& cavity);
  void joinSmall(Worker& worker, const std::vector<std::int32_t>& cells);
  void joinLarge(const Worker& worker, const std::vector<std::int32_t>& cells);

  std::vector<Vec3> points_;
  std::vector<std::int32_t> cellOf_; // per point
  RawVector<Cell> cells_;
  std::vector<std::uint8_t> marks_; // per cell; between uses its slab, or 0, times kMarks
  std::vector<std::int32_t> local_; // per point: its place in locals, if there
  std::vector<std::uint8_t> slabs_; // per point, while there are some; else empty
  std::size_t mostCells_ = kMostCells;
  int slabAxis_ = 0;
  std::vector<double> slabBorders_;
  Worker anywhere_;
};

} // namespace hybridtree
