// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/SkeletonKernels.h"

#include <algorithm>
#include <array>

// Compiled once per instruction set; what is between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE
// is seen several times.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/SkeletonKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

HWY_INLINE V set(double value)
{
  return hn::Set(D(), value);
}

HWY_INLINE V dot(const Vec3& a, V x, V y, V z)
{
  return hn::MulAdd(set(a[0]), x, hn::MulAdd(set(a[1]), y, hn::Mul(set(a[2]), z)));
}

HWY_INLINE V squaredNorm(V x, V y, V z)
{
  return hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
}

// What the kernels ask of a shape: offset(), the vector from its nearest point; squared(), the
// squared length of that, where cheaper without the vector; signedDistance() of a volume.

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

// Exponent 0 means: known only at run time.
template <int Exponent>
HWY_INLINE V power(V base, int exponent)
{
  if constexpr (Exponent == 1)
  {
    return base;
  }
  else if constexpr (Exponent == 2)
  {
    return hn::Mul(base, base);
  }
  else if constexpr (Exponent == 3)
  {
    return hn::Mul(hn::Mul(base, base), base);
  }
  else
  {
    V result = set(1.0);
    for (int rest = exponent; rest > 0; rest >>= 1)
    {
      if (rest & 1)
      {
        result = hn::Mul(result, base);
      }
      base = hn::Mul(base, base);
    }
    return result;
  }
}

// 1 - d^2 / R^2, not below 0.
HWY_INLINE V rest(const Falloff& falloff, V squared)
{
  return hn::Max(
    hn::Zero(D()), hn::NegMulAdd(squared, set(falloff.inverseSquaredRadius), set(1.0)));
}

// The loop bodies hold copies, which the compiler may keep in registers: what a reference names
// could be overwritten by the output as far as it knows. Each handles one vector of points at x, y,
// z and its `out` arrays.

template <class Math>
struct DistanceBody
{
  Math math;
  HWY_INLINE void operator()(
    const double* x, const double* y, const double* z, const std::array<double*, 1>& out) const
  {
    const D d;
    hn::StoreU(
      hn::Sqrt(math.squared(hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z))), d, out[0]);
  }
};

template <class Math>
struct SignedDistanceBody
{
  Math math;
  HWY_INLINE void operator()(
    const double* x, const double* y, const double* z, const std::array<double*, 1>& out) const
  {
    const D d;
    hn::StoreU(math.signedDistance(hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)), d, out[0]);
  }
};

template <class Math>
struct DistanceAndGradientBody
{
  Math math;
  HWY_INLINE void operator()(
    const double* px, const double* py, const double* pz, const std::array<double*, 4>& out) const
  {
    const D d;
    V x = hn::LoadU(d, px);
    V y = hn::LoadU(d, py);
    V z = hn::LoadU(d, pz);
    math.offset(x, y, z);
    const V distance = hn::Sqrt(squaredNorm(x, y, z));
    const V inverse =
      hn::IfThenElseZero(hn::Gt(distance, hn::Zero(d)), hn::Div(set(1.0), distance));
    hn::StoreU(distance, d, out[0]);
    hn::StoreU(hn::Mul(x, inverse), d, out[1]);
    hn::StoreU(hn::Mul(y, inverse), d, out[2]);
    hn::StoreU(hn::Mul(z, inverse), d, out[3]);
  }
};

template <class Math, int Exponent>
struct AddFalloffBody
{
  Math math;
  const Falloff falloff;
  HWY_INLINE void operator()(
    const double* x, const double* y, const double* z, const std::array<double*, 1>& out) const
  {
    const D d;
    const V u = rest(falloff, math.squared(hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)));
    const V value = power<Exponent>(u, falloff.exponent);
    hn::StoreU(hn::MulAdd(set(falloff.amplitude), value, hn::LoadU(d, out[0])), d, out[0]);
  }
};

template <class Math, int Exponent>
struct AddFalloffWithGradientBody
{
  Math math;
  const Falloff falloff;
  HWY_INLINE void operator()(
    const double* px, const double* py, const double* pz, const std::array<double*, 4>& out) const
  {
    const D d;
    V x = hn::LoadU(d, px);
    V y = hn::LoadU(d, py);
    V z = hn::LoadU(d, pz);
    math.offset(x, y, z);
    const V u = rest(falloff, squaredNorm(x, y, z));
    constexpr int kLower = Exponent > 0 ? Exponent - 1 : 0;
    const V lower = power<kLower>(u, falloff.exponent - 1);
    // grad h = -2 n A / R^2 (1 - d^2/R^2)^(n-1) times the offset: no division by the distance.
    const V slope = hn::Mul(
      lower, set(-2.0 * falloff.exponent * falloff.amplitude * falloff.inverseSquaredRadius));
    const V value = hn::Mul(lower, u);
    hn::StoreU(hn::MulAdd(set(falloff.amplitude), value, hn::LoadU(d, out[0])), d, out[0]);
    hn::StoreU(hn::MulAdd(slope, x, hn::LoadU(d, out[1])), d, out[1]);
    hn::StoreU(hn::MulAdd(slope, y, hn::LoadU(d, out[2])), d, out[2]);
    hn::StoreU(hn::MulAdd(slope, z, hn::LoadU(d, out[3])), d, out[3]);
  }
};

// Runs the body over the batch; the points that do not fill a vector go through it in a padded
// copy, so that each value is computed alike wherever its point stands.
template <std::size_t Outputs, class Body>
HWY_INLINE void forEachVector(PointBatch points, std::array<double*, Outputs> out, const Body& body)
{
  const std::size_t lanes = hn::Lanes(D());
  std::size_t k = 0;
  for (; k + lanes <= points.size; k += lanes)
  {
    body(points.x + k, points.y + k, points.z + k, out);
    for (double*& array : out)
    {
      array += lanes;
    }
  }
  const std::size_t left = points.size - k;
  if (left == 0)
  {
    return;
  }
  constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(double);
  double copy[3 + Outputs][kLanes] = {};
  std::copy_n(points.x + k, left, copy[0]);
  std::copy_n(points.y + k, left, copy[1]);
  std::copy_n(points.z + k, left, copy[2]);
  std::array<double*, Outputs> outCopy;
  for (std::size_t array = 0; array < Outputs; ++array)
  {
    outCopy[array] = copy[3 + array];
    std::copy_n(out[array], left, outCopy[array]);
  }
  body(copy[0], copy[1], copy[2], outCopy);
  for (std::size_t array = 0; array < Outputs; ++array)
  {
    std::copy_n(outCopy[array], left, out[array]);
  }
}

template <class Shape, class Math>
struct Kernels
{
  static void distance(const Shape& shape, PointBatch points, double* out)
  {
    forEachVector<1>(points, { out }, DistanceBody<Math>{ Math{ shape } });
  }
  static void signedDistance(const Shape& shape, PointBatch points, double* out)
  {
    forEachVector<1>(points, { out }, SignedDistanceBody<Math>{ Math{ shape } });
  }
  static void distanceAndGradient(
    const Shape& shape, PointBatch points, double* out, VectorBatch gradient)
  {
    forEachVector<4>(points, { out, gradient.x, gradient.y, gradient.z },
      DistanceAndGradientBody<Math>{ Math{ shape } });
  }
  static void addFalloff(const Shape& shape, const Falloff& falloff, PointBatch points, double* sum)
  {
    switch (falloff.exponent)
    {
      case 2:
        forEachVector<1>(points, { sum }, AddFalloffBody<Math, 2>{ Math{ shape }, falloff });
        break;
      case 3:
        forEachVector<1>(points, { sum }, AddFalloffBody<Math, 3>{ Math{ shape }, falloff });
        break;
      default:
        forEachVector<1>(points, { sum }, AddFalloffBody<Math, 0>{ Math{ shape }, falloff });
    }
  }
  static void addFalloffWithGradient(const Shape& shape, const Falloff& falloff, PointBatch points,
    double* sum, VectorBatch gradient)
  {
    const std::array<double*, 4> out = { sum, gradient.x, gradient.y, gradient.z };
    switch (falloff.exponent)
    {
      case 2:
        forEachVector<4>(
          points, out, AddFalloffWithGradientBody<Math, 2>{ Math{ shape }, falloff });
        break;
      case 3:
        forEachVector<4>(
          points, out, AddFalloffWithGradientBody<Math, 3>{ Math{ shape }, falloff });
        break;
      default:
        forEachVector<4>(
          points, out, AddFalloffWithGradientBody<Math, 0>{ Math{ shape }, falloff });
    }
  }

  static const SkeletonKernels<Shape>* table()
  {
    static const SkeletonKernels<Shape> kernels = { &distance, &signedDistance,
      &distanceAndGradient, &addFalloff, &addFalloffWithGradient };
    return &kernels;
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
