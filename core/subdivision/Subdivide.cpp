// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/Subdivide.h"

#include "core/base/Error.h"
#include "core/subdivision/SkeletonTopology.h"
#include "core/subdivision/SubdivisionStep.h"

#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr double kMaxElements = 4e6;

void checkCount(const SkeletonGraph& graph, int level)
{
  if (level < 0 || level > kMaxSubdivisionLevel)
  {
    throw InvalidParameter("Level", level, "from 0 to 6");
  }
  const double count = double(graph.segments.size()) * std::exp2(level) +
    double(graph.triangles.size()) * std::exp2(2 * level);
  if (count > kMaxElements)
  {
    throw TooLarge("Level " + std::to_string(level) + " gives the skeleton " +
      std::to_string(std::int64_t(count)) + " segments and triangles; at most " +
      std::to_string(std::int64_t(kMaxElements)) + " are allowed. Choose a lower level.");
  }
}

RefinedSkeleton unrefined(const SkeletonGraph& graph)
{
  RefinedSkeleton result;
  static_cast<SkeletonGraph&>(result) = graph;
  result.segmentParents.resize(graph.segments.size());
  std::iota(result.segmentParents.begin(), result.segmentParents.end(), 0);
  result.triangleParents.resize(graph.triangles.size());
  std::iota(result.triangleParents.begin(), result.triangleParents.end(), 0);
  result.segmentParameters.assign(graph.segments.size(), { 0.0, 1.0 });
  result.triangleParameters.assign(graph.triangles.size(),
    { Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0) });
  return result;
}

void splitSegments(
  const RefinedSkeleton& coarse, const SkeletonTopology& topology, RefinedSkeleton& fine)
{
  for (std::size_t s = 0; s < coarse.segments.size(); ++s)
  {
    const auto middle = std::int32_t(coarse.points.size()) + topology.segmentEdge(s);
    const auto [a, b] = coarse.segments[s];
    const auto [from, to] = coarse.segmentParameters[s];
    fine.segments.push_back({ a, middle });
    fine.segments.push_back({ middle, b });
    fine.segmentParameters.push_back({ from, 0.5 * (from + to) });
    fine.segmentParameters.push_back({ 0.5 * (from + to), to });
    fine.segmentParents.insert(fine.segmentParents.end(), 2, coarse.segmentParents[s]);
  }
}

void splitTriangles(
  const RefinedSkeleton& coarse, const SkeletonTopology& topology, RefinedSkeleton& fine)
{
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
  {
    const Triangle& corner = coarse.triangles[t];
    const auto& at = coarse.triangleParameters[t];
    Triangle middle; // of the edge from a corner to the next
    std::array<Eigen::Vector2d, 3> middleAt;
    for (int k = 0; k < 3; ++k)
    {
      middle[k] = std::int32_t(coarse.points.size()) + topology.triangleEdge(t, k);
      middleAt[k] = 0.5 * (at[k] + at[(k + 1) % 3]);
    }
    for (int k = 0; k < 3; ++k)
    {
      const int before = (k + 2) % 3;
      fine.triangles.push_back({ corner[k], middle[k], middle[before] });
      fine.triangleParameters.push_back({ at[k], middleAt[k], middleAt[before] });
    }
    fine.triangles.push_back(middle);
    fine.triangleParameters.push_back(middleAt);
    fine.triangleParents.insert(fine.triangleParents.end(), 4, coarse.triangleParents[t]);
  }
}

} // namespace

RefinedSkeleton subdivide(const SkeletonGraph& graph, SubdivisionScheme scheme, int level)
{
  checkCount(graph, level);
  validate(graph);
  RefinedSkeleton result = unrefined(graph);
  for (int step = 0; step < level; ++step)
  {
    const SkeletonTopology topology(result);
    RefinedSkeleton fine;
    static_cast<SkeletonGraph&>(fine) = subdividedPoints(result, topology, scheme);
    splitSegments(result, topology, fine);
    splitTriangles(result, topology, fine);
    result = std::move(fine);
  }
  return result;
}

} // namespace hybridtree
