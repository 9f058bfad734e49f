// SPDX-License-Identifier: BSD-3-Clause
// Batched distance work on a shape from arithmetic on one vector of points. Included once per
// instruction set, as Highway's foreach_target has it; so no #pragma once.
//
// A file of kernels writes, for each of its shapes, a Math made from the Shape with
// - void offset(V& x, V& y, V& z) const: points in, vectors from their nearest points out;
// - V squared(V x, V y, V z) const: the squared length of that, where cheaper without the vector;
// - V signedDistance(V x, V y, V z) const: negative inside a volume,
// and hands out Kernels<Shape, Math>::table(). SkeletonKernels.cpp is the pattern.
#if defined(HYBRIDTREE_SKELETON_KERNELS) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_SKELETON_KERNELS
#undef HYBRIDTREE_SKELETON_KERNELS
#else
#define HYBRIDTREE_SKELETON_KERNELS
#endif

#include "core/geometry/SkeletonKernels.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>

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

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#endif // per-target include guard
