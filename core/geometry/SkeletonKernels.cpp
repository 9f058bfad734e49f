// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/SkeletonKernels.h"

// Compiled once per instruction set; what is between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE
// is seen several times.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/SkeletonKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

struct PointMath
{
  const PointShape shape;

  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    x = hn::Sub(x, set(shape.center[0]));
    y = hn::Sub(y, set(shape.center[1]));
    z = hn::Sub(z, set(shape.center[2]));
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    this->offset(x, y, z);
    return squaredNorm(x, y, z);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const { return hn::Sqrt(this->squared(x, y, z)); }
};

struct SegmentMath
{
  // What each point needs, once per batch: a segment of a tree stays its two ends.
  HWY_INLINE explicit SegmentMath(const SegmentShape& shape)
    : start(shape.start), edge(shape.end - shape.start)
  {
    const double squared = edge.squaredNorm();
    // A length whose square vanishes is none.
    footGradient = squared > 1e-300 ? Vec3(edge / squared) : Vec3(Vec3::Zero());
  }

  Vec3 start;
  Vec3 edge;
  Vec3 footGradient;

  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    x = hn::Sub(x, set(start[0]));
    y = hn::Sub(y, set(start[1]));
    z = hn::Sub(z, set(start[2]));
    const V foot = hn::Min(set(1.0), hn::Max(hn::Zero(D()), dot(footGradient, x, y, z)));
    x = hn::NegMulAdd(foot, set(edge[0]), x);
    y = hn::NegMulAdd(foot, set(edge[1]), y);
    z = hn::NegMulAdd(foot, set(edge[2]), z);
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    this->offset(x, y, z);
    return squaredNorm(x, y, z);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const { return hn::Sqrt(this->squared(x, y, z)); }
};

struct CircleMath
{
  const CircleShape shape;

  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    x = hn::Sub(x, set(shape.center[0]));
    y = hn::Sub(y, set(shape.center[1]));
    z = hn::Sub(z, set(shape.center[2]));
    const V height = dot(shape.normal, x, y, z);
    // The part of the vector in the plane of the circle, which points to the nearest point.
    V u = hn::NegMulAdd(height, set(shape.normal[0]), x);
    V v = hn::NegMulAdd(height, set(shape.normal[1]), y);
    V w = hn::NegMulAdd(height, set(shape.normal[2]), z);
    const V squaredRadial = squaredNorm(u, v, w);
    // On the axis that part is rounding noise, and all of the circle is nearest: take `side`.
    const V noise = hn::MulAdd(height, height, set(shape.radius * shape.radius));
    const auto onAxis = hn::Le(squaredRadial, hn::Mul(noise, set(1e-30)));
    const V scale = hn::Div(set(shape.radius), hn::Sqrt(squaredRadial));
    u = hn::IfThenElse(onAxis, set(shape.radius * shape.side[0]), hn::Mul(scale, u));
    v = hn::IfThenElse(onAxis, set(shape.radius * shape.side[1]), hn::Mul(scale, v));
    w = hn::IfThenElse(onAxis, set(shape.radius * shape.side[2]), hn::Mul(scale, w));
    x = hn::Sub(x, u);
    y = hn::Sub(y, v);
    z = hn::Sub(z, w);
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    x = hn::Sub(x, set(shape.center[0]));
    y = hn::Sub(y, set(shape.center[1]));
    z = hn::Sub(z, set(shape.center[2]));
    const V height = dot(shape.normal, x, y, z);
    const V u = hn::NegMulAdd(height, set(shape.normal[0]), x);
    const V v = hn::NegMulAdd(height, set(shape.normal[1]), y);
    const V w = hn::NegMulAdd(height, set(shape.normal[2]), z);
    const V across = hn::Sub(hn::Sqrt(squaredNorm(u, v, w)), set(shape.radius));
    return hn::MulAdd(height, height, hn::Mul(across, across));
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const { return hn::Sqrt(this->squared(x, y, z)); }
};

struct BoxMath
{
  const BoxShape shape;

  // Coordinates along the box's own axes.
  HWY_INLINE void toLocal(V& x, V& y, V& z) const
  {
    const V u = hn::Sub(x, set(shape.center[0]));
    const V v = hn::Sub(y, set(shape.center[1]));
    const V w = hn::Sub(z, set(shape.center[2]));
    x = dot(shape.axes.col(0), u, v, w);
    y = dot(shape.axes.col(1), u, v, w);
    z = dot(shape.axes.col(2), u, v, w);
  }
  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    this->toLocal(x, y, z);
    const V u = hn::Sub(x, this->clamped(x, 0));
    const V v = hn::Sub(y, this->clamped(y, 1));
    const V w = hn::Sub(z, this->clamped(z, 2));
    x = dot(shape.axes.row(0).transpose(), u, v, w);
    y = dot(shape.axes.row(1).transpose(), u, v, w);
    z = dot(shape.axes.row(2).transpose(), u, v, w);
  }
  HWY_INLINE V clamped(V value, int axis) const
  {
    return hn::Min(set(shape.half[axis]), hn::Max(set(-shape.half[axis]), value));
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    this->toLocal(x, y, z);
    const V zero = hn::Zero(D());
    const V u = hn::Max(zero, hn::Sub(hn::Abs(x), set(shape.half[0])));
    const V v = hn::Max(zero, hn::Sub(hn::Abs(y), set(shape.half[1])));
    const V w = hn::Max(zero, hn::Sub(hn::Abs(z), set(shape.half[2])));
    return squaredNorm(u, v, w);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const
  {
    this->toLocal(x, y, z);
    const V zero = hn::Zero(D());
    const V u = hn::Sub(hn::Abs(x), set(shape.half[0]));
    const V v = hn::Sub(hn::Abs(y), set(shape.half[1]));
    const V w = hn::Sub(hn::Abs(z), set(shape.half[2]));
    const V inside = hn::Min(zero, hn::Max(u, hn::Max(v, w)));
    return hn::Add(
      inside, hn::Sqrt(squaredNorm(hn::Max(zero, u), hn::Max(zero, v), hn::Max(zero, w))));
  }
};
const SkeletonKernels<PointShape>* pointKernels()
{
  return Kernels<PointShape, PointMath>::table();
}

const SkeletonKernels<SegmentShape>* segmentKernels()
{
  return Kernels<SegmentShape, SegmentMath>::table();
}

const SkeletonKernels<CircleShape>* circleKernels()
{
  return Kernels<CircleShape, CircleMath>::table();
}

const SkeletonKernels<BoxShape>* boxKernels()
{
  return Kernels<BoxShape, BoxMath>::table();
}

// The falloff over given distances: x is the distance, y and z are not read.

struct FalloffBody
{
  const Falloff falloff;
  HWY_INLINE void operator()(
    const double* x, const double*, const double*, const std::array<double*, 1>& out) const
  {
    const D d;
    const V distance = hn::LoadU(d, x);
    const V value = power<0>(rest(falloff, hn::Mul(distance, distance)), falloff.exponent);
    hn::StoreU(hn::Mul(set(falloff.amplitude), value), d, out[0]);
  }
};

struct FalloffWithSlopeBody
{
  const Falloff falloff;
  HWY_INLINE void operator()(
    const double* x, const double*, const double*, const std::array<double*, 2>& out) const
  {
    const D d;
    const V distance = hn::LoadU(d, x);
    const V u = rest(falloff, hn::Mul(distance, distance));
    const V lower = power<0>(u, falloff.exponent - 1);
    const double factor = -2.0 * falloff.exponent * falloff.inverseSquaredRadius;
    hn::StoreU(hn::Mul(set(falloff.amplitude), hn::Mul(lower, u)), d, out[0]);
    hn::StoreU(hn::Mul(set(factor * falloff.amplitude), hn::Mul(lower, distance)), d, out[1]);
  }
};

void falloff(const Falloff& falloff, const double* distance, double* value, std::size_t count)
{
  forEachVector<1>({ distance, distance, distance, count }, { value }, FalloffBody{ falloff });
}

void falloffWithSlope(
  const Falloff& falloff, const double* distance, double* value, double* slope, std::size_t count)
{
  forEachVector<2>(
    { distance, distance, distance, count }, { value, slope }, FalloffWithSlopeBody{ falloff });
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(pointKernels);
HWY_EXPORT(segmentKernels);
HWY_EXPORT(circleKernels);
HWY_EXPORT(boxKernels);
HWY_EXPORT(falloff);
HWY_EXPORT(falloffWithSlope);

const SkeletonKernels<PointShape>& kernelsFor(const PointShape&)
{
  static const SkeletonKernels<PointShape>* const kernels = HWY_DYNAMIC_DISPATCH(pointKernels)();
  return *kernels;
}

const SkeletonKernels<SegmentShape>& kernelsFor(const SegmentShape&)
{
  static const SkeletonKernels<SegmentShape>* const kernels =
    HWY_DYNAMIC_DISPATCH(segmentKernels)();
  return *kernels;
}

const SkeletonKernels<CircleShape>& kernelsFor(const CircleShape&)
{
  static const SkeletonKernels<CircleShape>* const kernels = HWY_DYNAMIC_DISPATCH(circleKernels)();
  return *kernels;
}

const SkeletonKernels<BoxShape>& kernelsFor(const BoxShape&)
{
  static const SkeletonKernels<BoxShape>* const kernels = HWY_DYNAMIC_DISPATCH(boxKernels)();
  return *kernels;
}

void evaluateFalloff(
  const Falloff& falloff, const double* distance, double* value, std::size_t count)
{
  HWY_DYNAMIC_DISPATCH(falloff)(falloff, distance, value, count);
}

void evaluateFalloffWithSlope(
  const Falloff& falloff, const double* distance, double* value, double* slope, std::size_t count)
{
  HWY_DYNAMIC_DISPATCH(falloffWithSlope)(falloff, distance, value, slope, count);
}

} // namespace hybridtree
#endif
