// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CheckPatch.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kTurnedOver = -0.2; // cosine to the normals
constexpr double kSliver = 0.05;     // height over longest side

/// \pre by rising `from`.
bool isClosedSortedFan(const FanSide* begin, const FanSide* end)
{
  const FanSide* at = begin;
  for (const FanSide* k = begin; k != end; ++k)
  {
    if (at->to == at->point || at->from == at->point || at->to == at->from)
    {
      return false;
    }
    const auto next = std::equal_range(begin, end, FanSide{ 0, at->to, 0 },
      [](const FanSide& a, const FanSide& b) { return a.from < b.from; });
    if (next.second - next.first != 1)
    {
      return false;
    }
    at = next.first;
    if (at == begin)
    {
      return k + 1 == end;
    }
  }
  return false;
}

} // namespace

bool isClosedFan(FanSide* begin, FanSide* end)
{
  if (end - begin < 3)
  {
    return false;
  }
  // Each is brought behind the one it continues. Fans are small: to look is faster than to sort.
  constexpr std::ptrdiff_t kMany = 24;
  if (end - begin > kMany)
  {
    std::sort(begin, end, [](const FanSide& a, const FanSide& b) { return a.from < b.from; });
    return isClosedSortedFan(begin, end);
  }
  for (FanSide* at = begin; at != end; ++at)
  {
    if (at->from == at->point || at->to == at->point || at->from == at->to)
    {
      return false;
    }
    FanSide* next = nullptr; // the one side that begins where this one ends
    for (FanSide* other = at + 1; other != end; ++other)
    {
      if (other->from == at->to)
      {
        if (next)
        {
          return false;
        }
        next = other;
      }
    }
    if (!next)
    {
      return at + 1 == end && at->to == begin->from;
    }
    if (at->to == begin->from)
    {
      return false;
    }
    std::swap(*(at + 1), *next);
  }
  return false;
}

std::vector<std::int32_t> faultyPoints(
  const TriangleMesh& mesh, const std::vector<Triangle>& around)
{
  const std::size_t points = mesh.points.size();
  std::vector<std::int32_t> count(points, 0); // of sides at each
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t v : triangle)
    {
      ++count[v];
    }
  }
  const auto forEachSide = [&](const Triangle& c, auto&& visit)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (static_cast<std::size_t>(c[k]) < points && count[c[k]] > 0)
      {
        visit(FanSide{ c[k], c[(k + 1) % 3], c[(k + 2) % 3] });
      }
    }
  };
  for (const Triangle& triangle : around)
  {
    forEachSide(triangle, [&](const FanSide& side) { ++count[side.point]; });
  }
  std::vector<std::int32_t> next(points, 0);
  for (std::size_t v = 1; v < points; ++v)
  {
    next[v] = next[v - 1] + count[v - 1];
  }
  const std::vector<std::int32_t> begin = next;
  std::vector<FanSide> sides(points > 0 ? static_cast<std::size_t>(next.back() + count.back()) : 0);
  for (const std::vector<Triangle>* triangles : { &mesh.triangles, &around })
  {
    for (const Triangle& triangle : *triangles)
    {
      forEachSide(triangle, [&](const FanSide& side) { sides[next[side.point]++] = side; });
    }
  }
  std::vector<std::int32_t> faulty;
  for (std::size_t v = 0; v < points; ++v)
  {
    if (count[v] > 0 && !isClosedFan(sides.data() + begin[v], sides.data() + next[v]))
    {
      faulty.push_back(static_cast<std::int32_t>(v));
    }
  }
  return faulty;
}

bool isTurned(const TriangleMesh& mesh, const Triangle& corners)
{
  const auto& [a, b, c] = corners;
  const Vec3 ab = mesh.points[b] - mesh.points[a];
  const Vec3 ac = mesh.points[c] - mesh.points[a];
  const Vec3 normal = ab.cross(ac);
  const double most = std::max(
    { normal.dot(mesh.normals[a]), normal.dot(mesh.normals[b]), normal.dot(mesh.normals[c]) });
  if (most >= 0.0)
  {
    return false; // nearly all of them
  }
  const double twiceArea = normal.norm();
  const double longest = std::max(
    { ab.squaredNorm(), ac.squaredNorm(), (mesh.points[c] - mesh.points[b]).squaredNorm() });
  return twiceArea > kSliver * longest && most < kTurnedOver * twiceArea;
}

std::vector<std::size_t> turnedTriangles(const TriangleMesh& mesh)
{
  std::vector<std::size_t> turned;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (isTurned(mesh, mesh.triangles[t]))
    {
      turned.push_back(t);
    }
  }
  return turned;
}

} // namespace hybridtree
