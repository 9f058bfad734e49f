// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CheckPatch.h"

#include <algorithm>
#include <tuple>

namespace hybridtree
{
namespace
{

constexpr double kTurnedOver = -0.2; // cosine to the normals
constexpr double kSliver = 0.05;     // height over longest side

/// A triangle as one of its points sees it.
struct Corner
{
  std::int32_t point;
  std::int32_t from; ///< the sides at the point go to here, and come from `to`
  std::int32_t to;
};

void addCorners(const Triangle& c, const std::vector<bool>& isNew, std::vector<Corner>& corners)
{
  for (int k = 0; k < 3; ++k)
  {
    if (static_cast<std::size_t>(c[k]) < isNew.size() && isNew[c[k]])
    {
      corners.push_back({ c[k], c[(k + 1) % 3], c[(k + 2) % 3] });
    }
  }
}

/// \pre begin to end are the corners at one point, by rising `from`.
bool isOneFan(const Corner* begin, const Corner* end)
{
  const auto count = static_cast<std::size_t>(end - begin);
  if (count < 3)
  {
    return false;
  }
  const Corner* at = begin;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (at->to == at->point || at->from == at->point || at->to == at->from)
    {
      return false;
    }
    const auto next = std::equal_range(begin, end, Corner{ 0, at->to, 0 },
      [](const Corner& a, const Corner& b) { return a.from < b.from; });
    if (next.second - next.first != 1)
    {
      return false;
    }
    at = next.first;
    if (at == begin)
    {
      return k + 1 == count;
    }
  }
  return false;
}

} // namespace

std::vector<std::int32_t> faultyPoints(
  const TriangleMesh& mesh, const std::vector<Triangle>& around)
{
  std::vector<bool> isNew(mesh.points.size(), false);
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t v : triangle)
    {
      isNew[v] = true;
    }
  }
  std::vector<Corner> corners;
  corners.reserve(3 * mesh.triangles.size() + around.size());
  for (const std::vector<Triangle>* triangles : { &mesh.triangles, &around })
  {
    for (const Triangle& triangle : *triangles)
    {
      addCorners(triangle, isNew, corners);
    }
  }
  std::sort(corners.begin(), corners.end(),
    [](const Corner& a, const Corner& b)
    { return std::tie(a.point, a.from, a.to) < std::tie(b.point, b.from, b.to); });
  std::vector<std::int32_t> faulty;
  for (std::size_t begin = 0; begin < corners.size();)
  {
    std::size_t end = begin;
    while (end < corners.size() && corners[end].point == corners[begin].point)
    {
      ++end;
    }
    if (!isOneFan(corners.data() + begin, corners.data() + end))
    {
      faulty.push_back(corners[begin].point);
    }
    begin = end;
  }
  return faulty;
}

std::vector<std::size_t> turnedTriangles(const TriangleMesh& mesh)
{
  std::vector<std::size_t> turned;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& c = mesh.triangles[t];
    const Vec3 normal = areaNormal(mesh, t);
    const double twiceArea = normal.norm();
    double longest = 0.0;
    double most = -twiceArea;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, (mesh.points[c[k]] - mesh.points[c[(k + 1) % 3]]).squaredNorm());
      most = std::max(most, normal.dot(mesh.normals[c[k]]));
    }
    if (twiceArea > kSliver * longest && most < kTurnedOver * twiceArea)
    {
      turned.push_back(t);
    }
  }
  return turned;
}

} // namespace hybridtree
