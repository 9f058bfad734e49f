// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SkeletonKernels.h"
#include "core/skeletons/Skeleton.h"

namespace hybridtree
{

/// A skeleton whose distance queries are the batched kernels over one shape.
template <class Shape>
class KernelSkeleton : public Skeleton
{
public:
  void distance(PointBatch points, double* distance) const override
  {
    kernelsFor(shape_).distance(shape_, points, distance);
  }
  void distanceAndGradient(PointBatch points, double* distance, VectorBatch gradient) const override
  {
    kernelsFor(shape_).distanceAndGradient(shape_, points, distance, gradient);
  }
  void signedDistance(PointBatch points, double* distance) const override
  {
    kernelsFor(shape_).signedDistance(shape_, points, distance);
  }
  void addFalloff(PointBatch points, const Falloff& falloff, double* sum) const override
  {
    kernelsFor(shape_).addFalloff(shape_, falloff, points, sum);
  }
  void addFalloffWithGradient(
    PointBatch points, const Falloff& falloff, double* sum, VectorBatch gradientSum) const override
  {
    kernelsFor(shape_).addFalloffWithGradient(shape_, falloff, points, sum, gradientSum);
  }

protected:
  explicit KernelSkeleton(const Shape& shape) : shape_(shape) {}

  const Shape shape_;
};

} // namespace hybridtree
