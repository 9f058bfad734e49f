// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"
#include "core/geometry/Falloff.h"

namespace hybridtree
{

///@{
/// The shapes the kernels know, as plain numbers.
struct PointShape
{
  Vec3 center;
};

struct SegmentShape
{
  Vec3 start;
  Vec3 end;
};

struct CircleShape
{
  Vec3 center;
  Vec3 normal; ///< unit
  Vec3 side;   ///< unit, across the normal: where points of the axis find their nearest point
  double radius;
};

/// The full box, not its surface.
struct BoxShape
{
  Vec3 center;
  Mat3 axes; ///< orthonormal columns
  Vec3 half; ///< half the lengths
};
///@}

/// Batched distance work on one shape. A value depends on its point alone, not on its place in the
/// batch. Output arrays may be the coordinate arrays' neighbours but must not overlap them.
template <class Shape>
struct SkeletonKernels
{
  /// Euclidean distance, 0 inside a volume.
  void (*distance)(const Shape&, PointBatch, double* distance);
  /// Negative inside a volume: minus the distance to its boundary.
  void (*signedDistance)(const Shape&, PointBatch, double* distance);
  /// And the unit vector from the nearest point of the shape; 0 where the distance is 0.
  void (*distanceAndGradient)(const Shape&, PointBatch, double* distance, VectorBatch gradient);
  /// sum[k] += h(distance of p_k). No square root where the shape allows.
  void (*addFalloff)(const Shape&, const Falloff&, PointBatch, double* sum);
  /// And gradientSum k += grad (h o distance)(p_k).
  void (*addFalloffWithGradient)(
    const Shape&, const Falloff&, PointBatch, double* sum, VectorBatch gradientSum);
};

///@{
/// The kernels for the widest vector instructions of this processor, chosen at run time.
const SkeletonKernels<PointShape>& kernelsFor(const PointShape&);
const SkeletonKernels<SegmentShape>& kernelsFor(const SegmentShape&);
const SkeletonKernels<CircleShape>& kernelsFor(const CircleShape&);
const SkeletonKernels<BoxShape>& kernelsFor(const BoxShape&);
///@}

///@{
/// h at `count` distances >= 0, in vectors as above; the arrays may be the same.
void evaluateFalloff(
  const Falloff& falloff, const double* distance, double* value, std::size_t count);
/// And slope = dh/dd. `value` may be `distance`; `slope` may not.
void evaluateFalloffWithSlope(
  const Falloff& falloff, const double* distance, double* value, double* slope, std::size_t count);
///@}

} // namespace hybridtree
