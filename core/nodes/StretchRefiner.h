// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/nodes/Node.h"
#include "core/nodes/SpaceWarp.h"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hybridtree
{

/// Splits the long edges of a mesh at their midpoints, where long is measured in the image under a
/// warp: longer than 4/3 edge lengths, and stretched or bowed by the warp.
///
/// Keeps track of where the corners of split triangles lie on their source triangle, which the mesh
/// itself only knows for one triangle around each point. Triangles keep their order; new points and
/// triangles come last.
class StretchRefiner
{
public:
  /// \param mesh of `node`, refined in place.   \param image of its points under the warp.
  StretchRefiner(TriangleMesh& mesh, std::vector<Vec3> image, const SpaceWarp& warp,
    double edgeLength, const Node& node, const Progress& progress);

  /// \throws Cancelled.
  void run();

  /// Of all points, the new ones included.
  std::vector<Vec3> takeImage() { return std::move(image_); }

private:
  using Edge = std::uint64_t; ///< the smaller point, then the larger
  using Corners = std::array<Eigen::Vector2d, 3>;

  static Edge edgeOf(const Triangle& triangle, int side);
  static std::int32_t firstOf(Edge edge) { return static_cast<std::int32_t>(edge >> 32); }
  static std::int32_t secondOf(Edge edge) { return static_cast<std::int32_t>(edge & 0xffffffffu); }

  bool isLong(Edge edge) const;
  void findLong();
  std::vector<Edge> deformedOf(const std::vector<Edge>& edges) const;
  std::vector<char> areBowed(const std::vector<Edge>& edges) const;
  void addMidpoints(const std::vector<Edge>& edges);
  void splitTriangles(const std::vector<Edge>& edges);
  void splitTriangle(std::size_t t, const std::array<std::int32_t, 3>& middle);
  std::vector<std::array<int, 3>> pattern(const std::array<std::int32_t, 6>& point) const;

  bool hasPlaces() const { return !mesh_.sourceTriangle.empty() && !mesh_.vertexOrigin.empty(); }
  Corners cornersOf(std::size_t t) const;
  Eigen::Vector2d placeOn(std::int32_t source, std::int32_t point) const;
  void recordOrigin(std::size_t t, std::int32_t point, const Eigen::Vector2d& place);
  void replaceTriangle(std::size_t t, const Triangle& made, const Corners& places);
  void appendTriangle(std::size_t t, const Triangle& made, const Corners& places);

  TriangleMesh& mesh_;
  std::vector<Vec3> image_;
  const SpaceWarp& warp_;
  const Node& node_;
  const double longSquared_;
  const double bow_;
  const Progress& progress_;
  const MeshPtr leaf_;
  const bool isLeaf_; ///< the mesh has the points of the leaf

  // Points never move, so what was left in one round is left in the next: only triangles that the
  // last round has made can have edges to split.
  std::vector<std::size_t> fresh_;
  bool allAreFresh_ = true;
  std::vector<std::size_t> triangles_;               ///< fresh ones with long edges
  std::vector<Edge> edges_;                          ///< long ones, in order
  std::unordered_map<std::size_t, Corners> corners_; ///< of triangles made here
};

} // namespace hybridtree
