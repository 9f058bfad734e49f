// SPDX-License-Identifier: BSD-3-Clause
// The field of a subdivided skeleton: its elements, grouped by what they are children of.
#include "core/nodes/SubdivisionSkeleton.h"

#include "core/base/Error.h"
#include "core/nodes/SubdivisionSkeletonText.h"

#include <numeric>

namespace hybridtree
{
namespace
{

// The kernels' reaches at the corners of one element.
template <std::size_t N>
std::array<double, N> reachesOf(const RefinedSkeleton& skeleton,
  const std::array<std::int32_t, N>& corners, const SubdivisionSkeletonOptions& options)
{
  std::array<double, N> reaches;
  for (std::size_t k = 0; k < N; ++k)
  {
    reaches[k] =
      options.kernel.influenceRatio * skeleton.radii[static_cast<std::size_t>(corners[k])];
  }
  if (options.radius == SkeletonRadius::Constant)
  {
    reaches.fill(std::accumulate(reaches.begin(), reaches.end(), 0.0) / N);
  }
  return reaches;
}

template <std::size_t N>
GroupedElement<N> child(const RefinedSkeleton& skeleton, const std::array<std::int32_t, N>& corners,
  std::size_t group, const SubdivisionSkeletonOptions& options)
{
  return { corners, reachesOf(skeleton, corners, options), static_cast<std::int32_t>(group) };
}

// The children of one coarse element are a group: coarse segments first.
GroupedElements groupedElements(const SkeletonGraph& coarse, const RefinedSkeleton& skeleton,
  const SubdivisionSkeletonOptions& options)
{
  GroupedElements elements;
  elements.points = skeleton.points;
  for (const double radius : skeleton.radii)
  {
    elements.reaches.push_back(options.kernel.influenceRatio * radius);
  }
  for (std::size_t k = 0; k < skeleton.segments.size(); ++k)
  {
    elements.segments.push_back(child(skeleton, skeleton.segments[k],
      static_cast<std::size_t>(skeleton.segmentParents[k]), options));
  }
  for (std::size_t k = 0; k < skeleton.triangles.size(); ++k)
  {
    elements.triangles.push_back(child(skeleton, skeleton.triangles[k],
      coarse.segments.size() + static_cast<std::size_t>(skeleton.triangleParents[k]), options));
  }
  for (const SkeletonSegment& ends : coarse.segments)
  {
    elements.groups.push_back({ ends[0], ends[1], -1 });
  }
  elements.groups.insert(elements.groups.end(), coarse.triangles.begin(), coarse.triangles.end());
  return elements;
}

} // namespace

SubdivisionSkeleton::ShapePtr SubdivisionSkeleton::makeShape(
  const SkeletonGraph& graph, const SubdivisionSkeletonOptions& options)
{
  validate(options.kernel);
  validate(options.blending);
  checkNames(options);
  if (!(options.refinement > 0.0 && options.refinement <= 1.0))
  {
    throw InvalidParameter("Refinement", options.refinement, "above 0 and at most 1");
  }
  RefinedSkeleton refined = subdivide(graph, options.scheme, options.level);
  BlendedField field(options.kernel, options.blending, groupedElements(graph, refined, options));
  return std::make_shared<SubdivisionSkeleton::Shape>(SubdivisionSkeleton::Shape{
    graph, options, std::move(refined), std::move(field), numberPieces(graph) });
}

} // namespace hybridtree
