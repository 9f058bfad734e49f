// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <functional>
#include <vector>

namespace hybridtree
{

/// Whether a triangle is no higher than `tolerance` over its longest side.
bool isFlat(const Vec3& a, const Vec3& b, const Vec3& c, double tolerance);

/// Rids a part of a surface of flat triangles: collapses their edges that are no longer than the
/// tolerance, and flips the longest side of the others. So it does, where asked, to triangles that
/// lie on each other back to back: the edge where the surface turns back is flipped, which takes
/// the doubled part away. Never changes the topology of the surface,
/// moves no point by more than the tolerance, leaves points on the border of the part alone.
class FlatTriangles
{
public:
  /// \param points of the mesh. \param triangles of the part; those of the mesh around each of
  /// their points are either all of the part, or the point is left alone.
  /// \param rank points of a lower one are kept when two merge.
  FlatTriangles(const std::vector<Vec3>& points, std::vector<Triangle> triangles,
    std::function<int(std::int32_t)> rank, double tolerance, bool unfolds);

  void remove();

  /// The triangles as they are now; corners are -1 for one that is gone.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Per triangle: the one in whose place it lies now (flips hand places on).
  const std::vector<std::int32_t>& place() const { return place_; }
  /// Pairs of points: the first has become the second.
  const std::vector<std::array<std::int32_t, 2>>& merged() const { return merged_; }

private:
  class Worker;

  const std::vector<Vec3>& points_;
  std::vector<Triangle> triangles_;
  std::function<int(std::int32_t)> rank_;
  double tolerance_;
  bool unfolds_;
  std::vector<std::int32_t> place_;
  std::vector<std::array<std::int32_t, 2>> merged_;
};

} // namespace hybridtree
