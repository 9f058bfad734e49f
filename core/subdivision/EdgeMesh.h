// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Triangles that know their edges by number, to be divided where edges are split. A triangle is
/// divided by those of its edges that are split, in two, three or four, so that none ends in the
/// middle of another's edge.
class EdgeMesh
{
public:
  struct Edge
  {
    std::int32_t a, b;
    std::int32_t element; ///< of one of its triangles
    std::int32_t middle = kWhole;
    std::array<std::int32_t, 2> halves{ -1, -1 }; ///< edges at a and at b, once it is split
  };
  static constexpr std::int32_t kWhole = -1;

  /// \param elements a number per triangle, which its parts keep.
  EdgeMesh(const std::vector<Triangle>& triangles, const std::vector<std::int32_t>& elements);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::int32_t>& elements() const { return elements_; }
  /// All there ever were. New ones are behind the others.
  const std::vector<Edge>& edges() const { return edges_; }
  /// Per triangle: its edges, from each corner to the next.
  const std::vector<std::array<std::int32_t, 3>>& edgesOf() const { return edgesOf_; }

  /// Puts a vertex on an edge. divide() has to follow.
  void split(std::int32_t edge, std::int32_t vertex);

  /// Divides the triangles of edges that are split. A rest of four corners is cut along the shorter
  /// of its diagonals.
  void divide(const std::vector<Vec3>& points);

private:
  std::int32_t addEdge(std::int32_t a, std::int32_t b, std::int32_t element);
  std::int32_t half(std::int32_t edge, std::int32_t corner) const;
  void add(const Triangle& triangle, const std::array<std::int32_t, 3>& edges);
  void divide(Triangle corners, std::array<std::int32_t, 3> edges, std::int32_t element,
    const std::vector<Vec3>& points);
  void divideInTwo(
    const Triangle& corners, const std::array<std::int32_t, 3>& edges, std::int32_t element);
  void divideInThree(const Triangle& corners, const std::array<std::int32_t, 3>& edges,
    std::int32_t element, const std::vector<Vec3>& points);
  void divideInFour(
    const Triangle& corners, const std::array<std::int32_t, 3>& edges, std::int32_t element);

  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> elements_;
  std::vector<std::array<std::int32_t, 3>> edgesOf_;
  std::vector<Edge> edges_;
  ///@{
  /// While triangles are divided: those before.
  std::vector<Triangle> wholes_;
  std::vector<std::int32_t> elementsOfWholes_;
  std::vector<std::array<std::int32_t, 3>> edgesOfWholes_;
  ///@}
};

} // namespace hybridtree
