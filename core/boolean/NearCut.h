// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <functional>
#include <vector>

namespace hybridtree
{

/// Room for the curves of a cut whose points have been moved: points nearer to them than `distance`
/// are merged into the curve, points of the curve nearer than that to each other into one, and
/// edges that pass close by a point of the curve are flipped; so are points that the curve has
/// passed over. Keeps the topology of the surface and the curve; leaves points on the border of the
/// part alone.
class NearCut
{
public:
  /// \param points of the mesh. \param triangles of the part. \param operand per triangle: the
  /// curve runs where it changes. \param isCut whether a point is on the curve.
  NearCut(const std::vector<Vec3>& points, std::vector<Triangle> triangles,
    std::vector<std::int8_t> operand, std::vector<Vec3> normals,
    std::function<bool(std::int32_t)> isCut, double distance);

  void run();

  ///@{ As in FlatTriangles.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::int32_t>& place() const { return place_; }
  const std::vector<std::array<std::int32_t, 2>>& merged() const { return merged_; }
  ///@}

private:
  class Worker;

  const std::vector<Vec3>& points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int8_t> operand_;
  std::vector<Vec3> normals_;
  std::function<bool(std::int32_t)> isCut_;
  double distance_;
  std::vector<std::int32_t> place_;
  std::vector<std::array<std::int32_t, 2>> merged_;
};

} // namespace hybridtree
