// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonGraph.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace hybridtree
{
namespace
{

[[noreturn]] void fail(const char* kind, std::size_t index, const std::string& what)
{
  throw InvalidGeometry(
    "The skeleton's " + std::string(kind) + " " + std::to_string(index) + " " + what);
}

void checkPoints(const SkeletonGraph& graph)
{
  if (graph.radii.size() != graph.points.size())
  {
    throw InvalidGeometry("The skeleton has " + std::to_string(graph.points.size()) +
      " points and " + std::to_string(graph.radii.size()) + " radii; give every point one radius.");
  }
  for (std::size_t k = 0; k < graph.points.size(); ++k)
  {
    if (!graph.points[k].allFinite())
    {
      fail("point", k, "has a coordinate that is not finite; correct or remove it.");
    }
    if (!std::isfinite(graph.radii[k]) || graph.radii[k] <= 0.0)
    {
      fail("point", k,
        "has the radius " + std::to_string(graph.radii[k]) + "; it must be finite and > 0.");
    }
  }
}

template <std::size_t N>
void checkCorners(const SkeletonGraph& graph,
  const std::vector<std::array<std::int32_t, N>>& elements, const char* kind)
{
  std::map<std::array<std::int32_t, N>, std::size_t> seen;
  for (std::size_t k = 0; k < elements.size(); ++k)
  {
    auto corners = elements[k];
    std::sort(corners.begin(), corners.end());
    if (corners.front() < 0 || std::size_t(corners.back()) >= graph.points.size())
    {
      const std::int32_t missing = corners.front() < 0 ? corners.front() : corners.back();
      fail(kind, k,
        "uses point " + std::to_string(missing) + ", which is not there; there are " +
          std::to_string(graph.points.size()) + " points, numbered from 0.");
    }
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end())
    {
      fail(kind, k, "uses a point twice; remove it.");
    }
    const auto [other, isNew] = seen.emplace(corners, k);
    if (!isNew)
    {
      fail(kind, k, "is the same as " + std::to_string(other->second) + "; remove one of them.");
    }
  }
}

void checkLengths(const SkeletonGraph& graph)
{
  for (std::size_t k = 0; k < graph.segments.size(); ++k)
  {
    const auto [a, b] = graph.segments[k];
    if (!((graph.points[b] - graph.points[a]).norm() > 0.0))
    {
      fail("segment", k, "has no length; move one of its points or merge them.");
    }
  }
}

void checkAreas(const SkeletonGraph& graph)
{
  for (std::size_t k = 0; k < graph.triangles.size(); ++k)
  {
    const auto [a, b, c] = graph.triangles[k];
    const Vec3 u = graph.points[b] - graph.points[a];
    const Vec3 v = graph.points[c] - graph.points[a];
    const double longest = std::max({ u.norm(), v.norm(), (v - u).norm() });
    if (!(u.cross(v).norm() > 1e-9 * longest * longest))
    {
      fail("triangle", k, "has no area; move one of its points, or use a segment.");
    }
  }
}

void checkEdges(const SkeletonGraph& graph)
{
  std::map<std::array<std::int32_t, 2>, int> uses;
  for (std::size_t k = 0; k < graph.triangles.size(); ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::int32_t a = graph.triangles[k][corner];
      const std::int32_t b = graph.triangles[k][(corner + 1) % 3];
      if (++uses[{ std::min(a, b), std::max(a, b) }] > 2)
      {
        fail("triangle", k,
          "is the third one at the edge of points " + std::to_string(a) + " and " +
            std::to_string(b) + "; give it points of its own there.");
      }
    }
  }
}

} // namespace

void validate(const SkeletonGraph& graph)
{
  if (graph.segments.empty() && graph.triangles.empty())
  {
    throw InvalidGeometry(
      "The skeleton has no segment and no triangle; join its points by lines or triangles.");
  }
  checkPoints(graph);
  checkCorners(graph, graph.segments, "segment");
  checkCorners(graph, graph.triangles, "triangle");
  checkLengths(graph);
  checkAreas(graph);
  checkEdges(graph);
}

} // namespace hybridtree
