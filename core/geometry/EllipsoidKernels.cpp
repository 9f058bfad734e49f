// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/EllipsoidKernels.h"

// Compiled once per instruction set, as SkeletonKernels.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/EllipsoidKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// With e the radii, e2 the smallest, z = |p| / e and r = (e / e2)^2, the nearest point of the
// surface is x_i = r_i p_i / (u + r_i - 1), where u > 0 solves
//   G(u) = (z_2 / u)^2 + (r_1 z_1 / (u + r_1 - 1))^2 + (r_0 z_0 / (u + r_0 - 1))^2 = 1.
// u = 1 on the surface, more outside. r_i - 1 is known without cancellation, so that u may be as
// small as it likes: points between the focal curve and the centre have u close to 0.
struct EllipsoidMath
{
  HWY_INLINE explicit EllipsoidMath(const EllipsoidShape& ellipsoid) : shape(ellipsoid)
  {
    const Vec3& e = shape.radii;
    for (int k = 0; k < 2; ++k)
    {
      over[k] = (e[k] - e[2]) * (e[k] + e[2]) / (e[2] * e[2]);
      toTerm[k] = e[k] / (e[2] * e[2]);
    }
    toTerm[2] = 1.0 / e[2];
  }

  EllipsoidShape shape;
  double over[2];   // r_i - 1
  double toTerm[3]; // r_i / e_i

  // The vector from the nearest point of the *surface*, in the world, and u - 1: negative inside.
  HWY_INLINE V fromSurface(V& x, V& y, V& z) const
  {
    const V px = hn::Sub(x, set(shape.center[0]));
    const V py = hn::Sub(y, set(shape.center[1]));
    const V pz = hn::Sub(z, set(shape.center[2]));
    const V a = dot(shape.axes.col(0), px, py, pz);
    const V b = dot(shape.axes.col(1), px, py, pz);
    V c = dot(shape.axes.col(2), px, py, pz);
    // In the plane of the longer axes the limit from above it: one of two nearest points, and no
    // case apart. This moves the point by much less than rounding has.
    const V tiny = set(1e-20 * shape.radii[2]);
    c = hn::IfThenElse(hn::Lt(hn::Abs(c), tiny), tiny, c);

    const V u = this->root(hn::Mul(hn::Abs(a), set(toTerm[0])), hn::Mul(hn::Abs(b), set(toTerm[1])),
      hn::Mul(hn::Abs(c), set(toTerm[2])));
    // p - x, without subtracting what may be nearly equal.
    const V t = hn::Sub(u, set(1.0));
    const V u0 = hn::Mul(a, hn::Div(t, hn::Add(u, set(over[0]))));
    const V u1 = hn::Mul(b, hn::Div(t, hn::Add(u, set(over[1]))));
    const V u2 = hn::Mul(c, hn::Div(t, u));
    x = dot(shape.axes.row(0).transpose(), u0, u1, u2);
    y = dot(shape.axes.row(1).transpose(), u0, u1, u2);
    z = dot(shape.axes.row(2).transpose(), u0, u1, u2);
    return t;
  }

  // u from r_i z_i. Each lane takes its own number of steps: its value is that of its point alone.
  HWY_INLINE V root(V w0, V w1, V w2) const
  {
    const V one = set(1.0);
    // Below the root: no term alone is above 1. Above it: all over u.
    V low = hn::Max(w2, hn::Max(hn::Sub(w0, set(over[0])), hn::Sub(w1, set(over[1]))));
    V high = hn::Max(low, hn::Sqrt(squaredNorm(w0, w1, w2)));
    auto active = hn::Lt(low, high);
    // Newton's method takes few steps, but where two terms of different growth meet, close to the
    // focal curve, it creeps there by a factor; a few halvings of the exponent's range help.
    for (int step = 0; step < kMostSteps && !hn::AllFalse(D(), active); ++step)
    {
      if (step % kRound < kNewtonSteps)
      {
        const V next = this->newton(w0, w1, w2, low);
        active = hn::And(active, hn::Gt(next, hn::Mul(low, set(1.0 + 4e-16))));
        low = hn::IfThenElse(active, hn::Min(next, high), low);
      }
      else
      {
        const V middle = hn::Sqrt(hn::Mul(low, high));
        const auto below = hn::Ge(this->value(w0, w1, w2, middle), one);
        low = hn::IfThenElse(hn::And(active, below), middle, low);
        high = hn::IfThenElse(hn::AndNot(below, active), middle, high);
      }
    }
    return low;
  }

  static constexpr int kNewtonSteps = 6;
  static constexpr int kRound = 10;
  static constexpr int kMostSteps = 100;

  HWY_INLINE V value(V w0, V w1, V w2, V u) const
  {
    return squaredNorm(
      hn::Div(w0, hn::Add(u, set(over[0]))), hn::Div(w1, hn::Add(u, set(over[1]))), hn::Div(w2, u));
  }

  // One step on 1 / sqrt(G) - 1: u + G (sqrt(G) - 1) / (-G' / 2).
  HWY_INLINE V newton(V w0, V w1, V w2, V u) const
  {
    const V one = set(1.0);
    const V i0 = hn::Div(one, hn::Add(u, set(over[0])));
    const V i1 = hn::Div(one, hn::Add(u, set(over[1])));
    const V i2 = hn::Div(one, u);
    const V q0 = hn::Mul(w0, i0);
    const V q1 = hn::Mul(w1, i1);
    const V q2 = hn::Mul(w2, i2);
    const V g = squaredNorm(q0, q1, q2);
    const V slope = hn::MulAdd(
      hn::Mul(q0, q0), i0, hn::MulAdd(hn::Mul(q1, q1), i1, hn::Mul(hn::Mul(q2, q2), i2)));
    return hn::MulAdd(g, hn::Div(hn::Sub(hn::Sqrt(g), one), slope), u);
  }

  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    const V t = this->fromSurface(x, y, z);
    const auto outside = hn::Gt(t, hn::Zero(D()));
    x = hn::IfThenElseZero(outside, x);
    y = hn::IfThenElseZero(outside, y);
    z = hn::IfThenElseZero(outside, z);
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    this->offset(x, y, z);
    return squaredNorm(x, y, z);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const
  {
    const V t = this->fromSurface(x, y, z);
    return hn::CopySign(hn::Sqrt(squaredNorm(x, y, z)), t);
  }
};

const SkeletonKernels<EllipsoidShape>* ellipsoidKernels()
{
  return Kernels<EllipsoidShape, EllipsoidMath>::table();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(ellipsoidKernels);

const SkeletonKernels<EllipsoidShape>& kernelsFor(const EllipsoidShape&)
{
  static const SkeletonKernels<EllipsoidShape>* const kernels =
    HWY_DYNAMIC_DISPATCH(ellipsoidKernels)();
  return *kernels;
}

} // namespace hybridtree
#endif
