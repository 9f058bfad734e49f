// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

using Vec2 = Eigen::Vector2d;

/// Triangles of the inside of a simple polygon with no other points than its corners, by cutting
/// ears. \pre counter-clockwise, simple; corners may lie on one line with their neighbours. Bridges
/// to holes may be there: an edge that is passed both ways, between corners of equal coordinates.
/// \returns two less than the corners; fewer where the outline crosses itself.
std::vector<Triangle> triangulatePolygon(const std::vector<Vec2>& outline);

/// Constrained Delaunay triangulation of the inside of a simple polygon, to which points are added
/// one by one. Triangles are counter-clockwise, and none has an area of 0. Points keep their
/// numbers.
class PlanarTriangulation
{
public:
  /// \pre as triangulatePolygon.
  explicit PlanarTriangulation(const std::vector<Vec2>& outline);

  /// Of triangles that are there; their edges are flipped to Delaunay. \param fixed 1 for points
  /// that smooth() leaves where they are: those of the border at least.
  /// \pre the triangles are counter-clockwise and meet in whole edges, two at most; each point is
  /// one of theirs.
  PlanarTriangulation(
    std::vector<Vec2> points, std::vector<char> fixed, std::vector<Triangle> triangles);

  /// A point on the outline, between point `from` of it and the one after that. Returns its number.
  /// \pre p is there, to rounding.
  int splitOutline(int from, const Vec2& p);

  /// A point inside. Quick when the last one was near. Returns its number, -1 where the point is
  /// outside or at a point of the triangulation.
  int insert(const Vec2& p);

  /// Adds the middle of every inner edge longer than `length`, until there is none.
  void splitLongEdges(double length);

  /// Moves inner points to the middle of their neighbours, where that turns no triangle over, that
  /// many times, and flips edges back to Delaunay.
  void smooth(int rounds);

  double longestEdge() const;
  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

private:
  using Sides = std::array<std::int32_t, 3>;
  struct Edge
  {
    int triangle;
    int side; // from corner `side` to the next one
  };

  void connect();
  int turn(int a, int b, int c) const;
  int addPoint(const Vec2& p, bool onOutline);
  int locate(const Vec2& p) const;
  int scan(const Vec2& p) const;
  Edge outlineEdgeFrom(int point) const;
  Edge mirrored(Edge edge) const;
  void setTriangle(int t, const Triangle& corners, const Sides& neighbours);
  void replaceNeighbour(int t, int before, int after);
  bool shouldFlip(Edge edge) const;
  void flip(Edge edge);
  void legalize(std::vector<Edge>& edges);
  void flipAll();
  void relax(std::vector<Vec2>& before);

  std::vector<Vec2> points_;
  std::vector<char> fixed_; // points of the outline, and those said to be
  std::vector<Triangle> triangles_;
  std::vector<Sides> neighbours_; // across the side from corner k to k + 1; -1 at the outline
  std::vector<std::int32_t> triangleAt_; // one of each point
  int last_ = 0;
};

} // namespace hybridtree
