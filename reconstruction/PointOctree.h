// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Octree over the points of a surface, cut where they are flat enough: how a coarse subset is
/// chosen that is dense where the surface bends and sparse where it does not.
///
/// The root is a cube around the points. The roughness of a cell is the root mean square distance
/// of its points to their own best plane. Leaves that touch differ by one level at
/// most, since a surface that is followed through tetrahedra wants spacing that changes gradually.
class PointOctree
{
public:
  /// Sorts the points and makes every cell down to those with few points. O(n log n).
  /// \param points finite; must stay alive and unchanged.
  /// \throws Cancelled.
  PointOctree(const std::vector<Vec3>& points, const Progress& progress);

  /// Splits all cells of the first levels, those rougher than `roughness` (world units, >= 0), and
  /// what balance asks for.
  void splitToTolerance(double roughness);
  /// The same with the roughness for which no more than about `cells` leaves come out.
  /// \returns that roughness.
  double splitInto(std::size_t cells);

  /// Index of the point nearest to the centroid of each leaf's points, in spatial order. Leaves
  /// that the surface but grazes (their share of the parent's points is small) give none: their
  /// points would lie close to those of the leaves beside them.
  std::vector<std::int32_t> representatives() const;

  /// All points in spatial order (of the Morton code), and the leaf that each is in.
  const std::vector<std::int32_t>& order() const { return order_; }
  std::vector<std::int32_t> leafOfOrdered() const;
  std::size_t leafCount() const;

private:
  struct Cell
  {
    std::uint64_t key = 0; // Morton code, of 3 * level bits
    std::int32_t level = 0;
    std::int32_t begin = 0; // of the ordered points
    std::int32_t end = 0;
    std::int32_t parent = -1;
    std::int32_t firstChild = -1; // children follow each other; none: too few points to split
    std::int32_t childCount = 0;
    double roughness = 0.0;
    bool split = false;
  };

  void sortPoints(const Progress& progress);
  void makeCells(const Progress& progress);
  void measure(Cell& cell) const;
  void splitFirstLevels(std::size_t most);
  void splitRougher(double roughness);
  void balance();
  void splitAround(const Cell& cell);
  void splitDownTo(std::uint64_t key, std::int32_t level);
  std::int32_t nearestToCentroid(const Cell& cell) const;
  template <typename Visit>
  void forEachLeaf(const Visit& visit) const;

  const std::vector<Vec3>& points_;
  std::vector<std::int32_t> order_;
  std::vector<std::uint64_t> keys_; // sorted, per ordered point
  std::vector<Cell> cells_;         // level by level, each level by key
};

} // namespace hybridtree
