// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace hybridtree
{
namespace
{

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Ends of edges that one triangle has, each once, in order.
std::vector<std::int32_t> borderPoints(const TriangleMesh& mesh)
{
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& corners : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      edges.push_back(std::minmax({ corners[k], corners[(k + 1) % 3] }));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::int32_t> points;
  for (auto begin = edges.begin(); begin != edges.end();)
  {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& e) { return e != *begin; });
    if (end - begin == 1)
    {
      points.insert(points.end(), { begin->first, begin->second });
    }
    begin = end;
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Points in cubes as wide as the tolerance, so that those near to a place are in 27 of them.
class NearPoints
{
public:
  NearPoints(const std::vector<Vec3>& points, const Box3& box, double tolerance)
    : points_(points), lower_(box.min()), tolerance_(tolerance)
  {
  }

  /// The first point taken that is within the tolerance of this one, which is taken if there is
  /// none.
  std::int32_t firstNear(std::int32_t point)
  {
    const Vec3& p = points_[static_cast<std::size_t>(point)];
    const Cube at = this->cubeOf(p);
    std::int32_t first = point;
    for (std::int64_t k = 0; k < 27; ++k)
    {
      const Cube cube{ at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1 };
      const auto [begin, end] = cubes_.equal_range(keyOf(cube));
      for (auto other = begin; other != end; ++other)
      {
        const Vec3& q = points_[static_cast<std::size_t>(other->second)];
        first = (p - q).norm() <= tolerance_ ? std::min(first, other->second) : first;
      }
    }
    if (first == point)
    {
      cubes_.emplace(keyOf(at), point);
    }
    return first;
  }

private:
  using Cube = std::array<std::int64_t, 3>;

  Cube cubeOf(const Vec3& p) const
  {
    const Vec3 place = (p - lower_) / tolerance_;
    return { static_cast<std::int64_t>(place.x()), static_cast<std::int64_t>(place.y()),
      static_cast<std::int64_t>(place.z()) };
  }

  // At most a million cubes along an axis, and one more at each end.
  static std::int64_t keyOf(const Cube& cube)
  {
    return ((cube[0] + 1) << 42) + ((cube[1] + 1) << 21) + cube[2] + 1;
  }

  const std::vector<Vec3>& points_;
  const Vec3 lower_;
  const double tolerance_;
  std::unordered_multimap<std::int64_t, std::int32_t> cubes_;
};

} // namespace

std::vector<std::int32_t> seamPoints(const TriangleMesh& mesh)
{
  Box3 box;
  for (const Vec3& point : mesh.points)
  {
    box.extend(point);
  }
  const double tolerance = kSeamTolerance * box.diagonal().norm();
  if (!(tolerance > 0.0) || !std::isfinite(tolerance))
  {
    return {};
  }
  std::vector<std::int32_t> target(mesh.points.size());
  std::iota(target.begin(), target.end(), 0);
  bool joined = false;
  NearPoints near(mesh.points, box, tolerance);
  for (const std::int32_t point : borderPoints(mesh))
  {
    std::int32_t& to = target[static_cast<std::size_t>(point)];
    to = near.firstNear(point);
    joined = joined || to != point;
  }
  return joined ? target : std::vector<std::int32_t>();
}

} // namespace hybridtree
