// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SkeletonElementFields.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kSurroundings = 1.8; // radii around an element: axes end at 1.6

// Around the children of a coarse element.
Box3 boxAround(const SubdivisionSkeleton& leaf, std::size_t element)
{
  const RefinedSkeleton& refined = leaf.refined();
  Box3 box;
  double radius = 0.0;
  const auto add = [&](const auto& children, std::size_t parts, std::size_t parent)
  {
    for (std::size_t k = parent * parts; k < (parent + 1) * parts; ++k)
    {
      for (const std::int32_t point : children[k])
      {
        box.extend(refined.points[std::size_t(point)]);
        radius = std::max(radius, refined.radii[std::size_t(point)]);
      }
    }
  };
  const std::size_t segments = leaf.coarse().segments.size();
  const int level = leaf.options().level;
  if (element < segments)
  {
    add(refined.segments, std::size_t(1) << level, element);
  }
  else
  {
    add(refined.triangles, std::size_t(1) << (2 * level), element - segments);
  }
  const Vec3 margin = Vec3::Constant(kSurroundings * radius);
  return Box3(Vec3(box.min() - margin), Vec3(box.max() + margin));
}

} // namespace

struct SkeletonElementFields::Surroundings
{
  std::once_flag once;
  Box3 box;
  BlendSelection selection;
};

SkeletonElementFields::SkeletonElementFields(const SubdivisionSkeleton& leaf, Sums sums)
  : leaf_(leaf)
  , haveOwnSums_(sums == Sums::Own && leaf.options().blending.kind == BlendingKind::Paper)
{
  const SkeletonGraph& coarse = leaf.coarse();
  surroundings_.reset(new Surroundings[coarse.segments.size() + coarse.triangles.size()]);
}

SkeletonElementFields::~SkeletonElementFields() = default;

const SkeletonElementFields::Surroundings& SkeletonElementFields::surroundings(
  std::int32_t element) const
{
  Surroundings& result = surroundings_[std::size_t(element)];
  std::call_once(result.once,
    [&]
    {
      result.box = boxAround(leaf_, std::size_t(element));
      leaf_.convolution().select(result.box, result.selection);
    });
  return result;
}

void SkeletonElementFields::evaluate(
  std::int32_t element, PointBatch points, double* value, const VectorBatch* gradient) const
{
  if (haveOwnSums_)
  {
    leaf_.convolution().ownSum(element, points, value, gradient); // looks nowhere else
    return;
  }
  const Surroundings& near = this->surroundings(element);
  bool isInside = true;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    isInside = isInside && near.box.contains(points[k]);
  }
  const BlendSelection* selection = isInside ? &near.selection : nullptr;
  std::fill_n(value, points.size, 0.0);
  if (!gradient)
  {
    leaf_.convolution().addField(selection, points, value);
    return;
  }
  for (double* array : { gradient->x, gradient->y, gradient->z })
  {
    std::fill_n(array, points.size, 0.0);
  }
  leaf_.convolution().addFieldAndGradient(selection, points, value, *gradient);
}

} // namespace hybridtree
