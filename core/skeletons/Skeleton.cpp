// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Skeleton.h"

#include "core/base/Scratch.h"
#include "core/geometry/SkeletonKernels.h"

namespace hybridtree
{

void Skeleton::addFalloff(PointBatch points, const Falloff& falloff, double* sum) const
{
  ScratchArray value(points.size);
  this->distance(points, value.data());
  evaluateFalloff(falloff, value.data(), value.data(), points.size);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += value[k];
  }
}

void Skeleton::addFalloffWithGradient(
  PointBatch points, const Falloff& falloff, double* sum, VectorBatch gradientSum) const
{
  ScratchArray value(points.size);
  ScratchArray slope(points.size);
  ScratchVectors direction(points.size);
  const VectorBatch gradient = direction.batch();
  this->distanceAndGradient(points, value.data(), gradient);
  evaluateFalloffWithSlope(falloff, value.data(), value.data(), slope.data(), points.size);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += value[k];
    gradientSum.x[k] += slope[k] * gradient.x[k];
    gradientSum.y[k] += slope[k] * gradient.y[k];
    gradientSum.z[k] += slope[k] * gradient.z[k];
  }
}

} // namespace hybridtree
