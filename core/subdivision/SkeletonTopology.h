// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonGraph.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Two joined points of a skeleton, with all that joins them.
struct SkeletonEdge
{
  std::array<std::int32_t, 2> ends;
  std::array<std::int32_t, 2> triangles{ -1, -1 };
  std::int32_t segment = -1;

  bool onSurface() const { return triangles[0] >= 0; }
  /// A curve's segment, a surface's border, or a crease; otherwise the smooth inside of a surface.
  bool sharp() const { return segment >= 0 || triangles[1] < 0; }
  std::int32_t otherEnd(std::int32_t point) const { return ends[0] == point ? ends[1] : ends[0]; }
};

/// How a point of a skeleton moves and what goes on through it.
struct SkeletonVertex
{
  enum class Kind
  {
    Surface, ///< surrounded by a surface, with at most one crease: curves that end here follow it
    Curve,   ///< a curve, border or crease passes: `along` are its neighbours on it
    Corner   ///< an end, a junction, or where pieces meet: stays
  };
  Kind kind = Kind::Corner;
  std::array<std::int32_t, 2> along{ -1, -1 };

  /// Where the curve from `neighbour` goes on behind this point; -1 where it ends.
  std::int32_t beyond(std::int32_t neighbour) const;
};

/// Neighbours of a point on one side of its sharp edges, in order: consecutive ones share a
/// triangle with the point. A closed one goes all around; otherwise the first and the last edge are
/// sharp.
struct SkeletonSector
{
  std::vector<std::int32_t> ring;
  bool closed = false;
  std::size_t triangles() const { return closed ? ring.size() : ring.size() - 1; }
};

/// Adjacency of a skeleton graph.
///
/// One rule decides what is smooth where pieces meet, so that all children of a shared point and of
/// a shared edge stay attached. A point all surrounded by a surface moves with it. Any other point
/// that has exactly two segments moves with their curve, one with none and one border with its
/// border; all else (ends, junctions, surfaces that touch in a point, a curve that ends at a
/// border) stays.
class SkeletonTopology
{
public:
  /// \pre validate(graph)
  explicit SkeletonTopology(const SkeletonGraph& graph);

  const std::vector<SkeletonEdge>& edges() const { return edges_; }
  const std::vector<SkeletonVertex>& vertices() const { return vertices_; }
  std::int32_t segmentEdge(std::size_t segment) const { return segmentEdges_[segment]; }
  /// Edge from a corner of a triangle to the next one.
  std::int32_t triangleEdge(std::size_t triangle, int corner) const
  {
    return triangleEdges_[triangle][corner];
  }
  /// The edge of a triangle between two of its corners.
  std::int32_t triangleEdge(std::int32_t triangle, std::int32_t a, std::int32_t b) const;
  std::int32_t opposite(std::int32_t triangle, const SkeletonEdge& edge) const;

  /// Around point `center`, with the far end of `edge`, which is smooth, at `place` in the ring.
  SkeletonSector sector(std::int32_t center, const SkeletonEdge& edge, std::size_t& place) const;

  /// Edges at a point: begin and end.
  std::array<const std::int32_t*, 2> edgesAt(std::int32_t point) const
  {
    return { edgesAt_.data() + firstEdgeAt_[point], edgesAt_.data() + firstEdgeAt_[point + 1] };
  }

private:
  void makeEdges();
  void makeEdgesAt();
  SkeletonVertex classify(std::int32_t point) const;
  bool isSurrounded(std::int32_t point) const;
  std::size_t fanCount(std::int32_t point) const;
  // Neighbours of center met from `edge` through `triangle` up to a sharp edge or back to `edge`.
  std::vector<std::int32_t> walk(
    std::int32_t center, const SkeletonEdge& edge, std::int32_t triangle, bool overCreases) const;

  const SkeletonGraph& graph_;
  std::vector<SkeletonEdge> edges_;
  std::vector<std::int32_t> segmentEdges_;
  std::vector<std::array<std::int32_t, 3>> triangleEdges_;
  std::vector<std::int32_t> firstEdgeAt_;
  std::vector<std::int32_t> edgesAt_;
  std::vector<SkeletonVertex> vertices_;
};

} // namespace hybridtree
