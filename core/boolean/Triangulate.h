// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace hybridtree
{

/// A corner of a polygon cut out of a triangle, seen in the triangle's plane.
struct PlanarPoint
{
  double x, y;
  /// Bits 0 to 2: lies on these edges of the triangle. Two points on one edge may not be joined by
  /// a diagonal: the neighbour across the edge might choose the same.
  std::uint8_t edges;
};

inline double squaredDistance(const PlanarPoint& a, const PlanarPoint& b)
{
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Triangulates polygons with holes by clipping ears, larger ones then toward Delaunay by flips.
/// Where rounding has folded a polygon, so that ears cover something twice, the triangulation with
/// the least area turned around is looked for among all.
///
/// Answers for any loops, for those too that rounding has made touch or cross themselves: every
/// pair of consecutive points becomes an edge of one triangle, every other edge is one of two.
/// Keep one per thread: it reuses its memory.
class Triangulator
{
public:
  using Loop = std::vector<std::int32_t>;

  /// \param points in the plane. \param loops of points, the outer one first and counter-clockwise,
  /// holes clockwise. \param triangles appended to, as indices into points.
  /// \return false, and nothing appended, where no such triangulation is found: fans around new
  /// points will do.
  bool triangulate(const std::vector<PlanarPoint>& points, const std::vector<Loop>& loops,
    std::vector<Triangle>& triangles);

private:
  using Side = std::pair<std::int32_t, std::int32_t>;
  using Way = std::array<std::size_t, 2>;

  // Of clipping a tip, the least first.
  enum class Harm
  {
    None,
    Flat,
    Overlap,
    Forbidden
  };

  int turn(std::int32_t a, std::int32_t b, std::int32_t c) const;
  bool mayJoin(std::int32_t a, std::int32_t b) const;
  bool bridge(const std::vector<Loop>& loops);
  bool isVisible(std::int32_t from, std::int32_t to, const std::vector<Loop>& loops) const;
  bool isOpen(std::int32_t from, std::int32_t to, const std::vector<Loop>& loops) const;
  PlanarPoint inwardOf(const Loop& hole, std::size_t h) const;
  const PlanarPoint& leaving(const Loop& loop, std::size_t from, std::size_t step) const;
  bool isAround(std::size_t k, const Loop& hole, std::size_t h) const;
  std::optional<Way> anyWay(const Loop& hole, const std::vector<Loop>& walls) const;
  bool clip();
  void cut(std::size_t tip);
  bool isSpike(std::size_t tip, double tolerance) const;
  void clipSpikes();
  Triangle cornersAt(std::size_t tip) const;
  double offset(std::int32_t from, std::int32_t to, std::int32_t point) const;
  Harm harmOf(std::size_t tip) const;
  double tolerance() const;
  bool mayClip(std::int32_t a, std::int32_t c) const;
  bool isEar(std::size_t tip) const;
  double shape(std::size_t tip) const;
  std::size_t chooseSmall() const;
  std::size_t chooseLarge(std::size_t from) const;
  std::size_t chooseAny() const;
  std::optional<Side> repeatedEdge() const;
  double doubleArea(std::int32_t a, std::int32_t b, std::int32_t c) const;
  double foldedArea() const;
  bool isFolded() const;
  bool unfold();
  bool chooseLeastFolded(const std::set<Side>& forbidden);
  double worstOf(std::int32_t a, std::int32_t b, std::int32_t left, std::int32_t right) const;
  bool flip(std::size_t t, std::size_t u, std::int32_t a, std::int32_t b);
  void improveSmall();
  void improveLarge();

  const std::vector<PlanarPoint>* points_ = nullptr;
  Loop polygon_;
  std::vector<std::size_t> next_, previous_;
  std::size_t left_ = 0;
  std::size_t at_ = 0;
  bool proper_ = true;
  bool hasHoles_ = false;
  std::set<Side> diagonals_; // and sides; of polygons with holes
  std::vector<Triangle> made_;
};

} // namespace hybridtree
