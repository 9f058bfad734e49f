// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/RoundKernels.h"

#include <cmath>
#include <limits>

// Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/RoundKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

HWY_INLINE V clamp(V value, double low, double high)
{
  return hn::Min(set(high), hn::Max(set(low), value));
}

HWY_INLINE V positive(V value)
{
  return hn::Max(hn::Zero(D()), value);
}

HWY_INLINE V squaredNorm(V x, V y)
{
  return hn::MulAdd(x, x, hn::Mul(y, y));
}

// What the half plane of a shape answers at a distance `radial` >= 0 from the axis and a height:
// offset(), the vector from the nearest point; squared(), the square of its length;
// signedDistance().

struct DiscPlane
{
  HWY_INLINE explicit DiscPlane(const DiscShape& shape) : reach(shape.radius) {}
  double reach;

  HWY_INLINE void offset(V& radial, V&) const { radial = positive(hn::Sub(radial, set(reach))); }
  HWY_INLINE V squared(V radial, V height) const
  {
    this->offset(radial, height);
    return squaredNorm(radial, height);
  }
  HWY_INLINE V signedDistance(V radial, V height) const
  {
    return hn::Sqrt(this->squared(radial, height));
  }
};

// A rectangle, of which `inner` and `half` may be 0.
struct RectanglePlane
{
  HWY_INLINE explicit RectanglePlane(const CylinderShape& shape)
    : half(shape.half), reach(shape.radius), inner(0.0)
  {
  }
  HWY_INLINE explicit RectanglePlane(const HollowCylinderShape& shape)
    : half(shape.half), reach(shape.outer), inner(shape.inner)
  {
  }
  double half;
  double reach;
  double inner;

  HWY_INLINE void offset(V& radial, V& height) const
  {
    radial = hn::Sub(radial, clamp(radial, inner, reach));
    height = hn::Sub(height, clamp(height, -half, half));
  }
  HWY_INLINE V squared(V radial, V height) const
  {
    this->offset(radial, height);
    return squaredNorm(radial, height);
  }
  HWY_INLINE V signedDistance(V radial, V height) const
  {
    const double none = -std::numeric_limits<double>::infinity();
    const V across = hn::Max(hn::Sub(radial, set(reach)),
      inner > 0.0 ? hn::Sub(set(inner), radial) : set(none)); // without a bore there is no wall
    const V over = hn::Sub(hn::Abs(height), set(half));
    const V inside = hn::Min(hn::Zero(D()), hn::Max(across, over));
    const V u = positive(across);
    const V v = positive(over);
    return hn::Add(inside, hn::Sqrt(squaredNorm(u, v)));
  }
};

// A trapezium: the nearest point is on the nearer cap or on the slanted side.
struct ConePlane
{
  HWY_INLINE explicit ConePlane(const ConeShape& shape)
    : half(shape.half)
    , reach(std::max(shape.bottom, shape.top))
    , bottom(shape.bottom)
    , top(shape.top)
  {
    const double run = top - bottom;
    const double length = std::hypot(run, 2.0 * half);
    alongRadial = run / length;
    alongHeight = 2.0 * half / length;
    side = length;
  }
  double half;
  double reach;
  double bottom;
  double top;
  double alongRadial; // unit vector up the side
  double alongHeight;
  double side; // its length

  // Vector from the nearest point of the boundary, and whether the point is inside.
  HWY_INLINE hn::Mask<D> fromBoundary(V& radial, V& height) const
  {
    const V zero = hn::Zero(D());
    const V over = hn::Sub(hn::Abs(height), set(half));
    const auto below = hn::Lt(height, zero);
    const V capRadial = positive(hn::Sub(radial, hn::IfThenElse(below, set(bottom), set(top))));
    const V capHeight = hn::IfThenElse(below, hn::Neg(over), over);

    const V fromRadial = hn::Sub(radial, set(bottom));
    const V fromHeight = hn::Add(height, set(half));
    const V foot = clamp(
      hn::MulAdd(set(alongRadial), fromRadial, hn::Mul(set(alongHeight), fromHeight)), 0.0, side);
    const V sideRadial = hn::NegMulAdd(foot, set(alongRadial), fromRadial);
    const V sideHeight = hn::NegMulAdd(foot, set(alongHeight), fromHeight);

    const V beside =
      hn::NegMulAdd(set(alongRadial), fromHeight, hn::Mul(set(alongHeight), fromRadial));
    const auto inside = hn::And(hn::Lt(over, zero), hn::Lt(beside, zero));
    const V capSquared = squaredNorm(capRadial, capHeight);
    const V sideSquared = squaredNorm(sideRadial, sideHeight);
    const auto cap = hn::Lt(capSquared, sideSquared);
    radial = hn::IfThenElse(cap, capRadial, sideRadial);
    height = hn::IfThenElse(cap, capHeight, sideHeight);
    return inside;
  }
  HWY_INLINE void offset(V& radial, V& height) const
  {
    const auto inside = this->fromBoundary(radial, height);
    radial = hn::IfThenZeroElse(inside, radial);
    height = hn::IfThenZeroElse(inside, height);
  }
  HWY_INLINE V squared(V radial, V height) const
  {
    this->offset(radial, height);
    return squaredNorm(radial, height);
  }
  HWY_INLINE V signedDistance(V radial, V height) const
  {
    const auto inside = this->fromBoundary(radial, height);
    const V distance = hn::Sqrt(squaredNorm(radial, height));
    return hn::IfThenElse(inside, hn::Neg(distance), distance);
  }
};

// Two circles and their common tangent. Where a point stands along the tangent, from where it
// leaves the first circle, says which of the three it sees; inside as well as outside.
struct ConeSpherePlane
{
  HWY_INLINE explicit ConeSpherePlane(const ConeSphereShape& shape)
    : reach(shape.bottom), bottom(shape.bottom), top(shape.top), length(shape.length)
  {
    normalHeight = length > 0.0 ? (bottom - top) / length : 0.0;
    // 1 - s^2 without cancellation.
    normalRadial = length > 0.0
      ? std::sqrt((length - (bottom - top)) * (length + (bottom - top))) / length
      : 1.0;
  }
  double reach;
  double bottom;
  double top;
  double length;
  double normalRadial; // unit normal of the tangent
  double normalHeight;

  struct Seen
  {
    V height;           // over the centre of the circle it sees
    V toCenter;         // distance to that
    hn::Mask<D> circle; // rather than the tangent
    V distance;         // signed
  };
  HWY_INLINE Seen see(V radial, V height) const
  {
    const V along = hn::NegMulAdd(set(normalHeight), radial, hn::Mul(set(normalRadial), height));
    const auto first = hn::Lt(along, hn::Zero(D()));
    const auto second = hn::Ge(along, set(normalRadial * length));
    Seen seen;
    seen.circle = hn::Or(first, second);
    seen.height = hn::IfThenElse(first, height, hn::Sub(height, set(length)));
    seen.toCenter = hn::Sqrt(squaredNorm(radial, seen.height));
    const V toCircle = hn::Sub(seen.toCenter, hn::IfThenElse(first, set(bottom), set(top)));
    const V toTangent = hn::Sub(
      hn::MulAdd(set(normalRadial), radial, hn::Mul(set(normalHeight), height)), set(bottom));
    seen.distance = hn::IfThenElse(seen.circle, toCircle, toTangent);
    return seen;
  }
  HWY_INLINE void offset(V& radial, V& height) const
  {
    const Seen seen = this->see(radial, height);
    const auto outside = hn::Gt(seen.distance, hn::Zero(D()));
    const V scale = hn::Div(seen.distance, seen.toCenter);
    radial = hn::IfThenElseZero(outside,
      hn::IfThenElse(
        seen.circle, hn::Mul(scale, radial), hn::Mul(seen.distance, set(normalRadial))));
    height = hn::IfThenElseZero(outside,
      hn::IfThenElse(
        seen.circle, hn::Mul(scale, seen.height), hn::Mul(seen.distance, set(normalHeight))));
  }
  HWY_INLINE V squared(V radial, V height) const
  {
    const V distance = positive(this->see(radial, height).distance);
    return hn::Mul(distance, distance);
  }
  HWY_INLINE V signedDistance(V radial, V height) const
  {
    return this->see(radial, height).distance;
  }
};

// From space to the half plane and back.
template <class Shape, class Plane>
struct RevolvedMath
{
  HWY_INLINE explicit RevolvedMath(const Shape& shape) : frame(shape.frame), plane(shape) {}
  const AxisFrame frame;
  const Plane plane;

  // x, y and z become the vector across the axis.
  HWY_INLINE void toPlane(V& x, V& y, V& z, V& radial, V& height) const
  {
    x = hn::Sub(x, set(frame.origin[0]));
    y = hn::Sub(y, set(frame.origin[1]));
    z = hn::Sub(z, set(frame.origin[2]));
    height = dot(frame.axis, x, y, z);
    x = hn::NegMulAdd(height, set(frame.axis[0]), x);
    y = hn::NegMulAdd(height, set(frame.axis[1]), y);
    z = hn::NegMulAdd(height, set(frame.axis[2]), z);
    radial = hn::Sqrt(squaredNorm(x, y, z));
  }
  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    V radial, height;
    this->toPlane(x, y, z, radial, height);
    // On the axis the vector across is rounding noise: take `side`.
    const V noise = hn::MulAdd(height, height, set(plane.reach * plane.reach));
    const auto onAxis = hn::Le(hn::Mul(radial, radial), hn::Mul(noise, set(1e-30)));
    const V inverse = hn::Div(set(1.0), radial);
    x = hn::IfThenElse(onAxis, set(frame.side[0]), hn::Mul(inverse, x));
    y = hn::IfThenElse(onAxis, set(frame.side[1]), hn::Mul(inverse, y));
    z = hn::IfThenElse(onAxis, set(frame.side[2]), hn::Mul(inverse, z));
    plane.offset(radial, height);
    x = hn::MulAdd(radial, x, hn::Mul(height, set(frame.axis[0])));
    y = hn::MulAdd(radial, y, hn::Mul(height, set(frame.axis[1])));
    z = hn::MulAdd(radial, z, hn::Mul(height, set(frame.axis[2])));
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    V radial, height;
    this->toPlane(x, y, z, radial, height);
    return plane.squared(radial, height);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const
  {
    V radial, height;
    this->toPlane(x, y, z, radial, height);
    return plane.signedDistance(radial, height);
  }
};

template <class Shape, class Plane>
using RevolvedKernels = Kernels<Shape, RevolvedMath<Shape, Plane>>;

const SkeletonKernels<DiscShape>* discKernels()
{
  return RevolvedKernels<DiscShape, DiscPlane>::table();
}

const SkeletonKernels<CylinderShape>* cylinderKernels()
{
  return RevolvedKernels<CylinderShape, RectanglePlane>::table();
}

const SkeletonKernels<HollowCylinderShape>* hollowCylinderKernels()
{
  return RevolvedKernels<HollowCylinderShape, RectanglePlane>::table();
}

const SkeletonKernels<ConeShape>* coneKernels()
{
  return RevolvedKernels<ConeShape, ConePlane>::table();
}

const SkeletonKernels<ConeSphereShape>* coneSphereKernels()
{
  return RevolvedKernels<ConeSphereShape, ConeSpherePlane>::table();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(discKernels);
HWY_EXPORT(cylinderKernels);
HWY_EXPORT(hollowCylinderKernels);
HWY_EXPORT(coneKernels);
HWY_EXPORT(coneSphereKernels);

const SkeletonKernels<DiscShape>& kernelsFor(const DiscShape&)
{
  static const auto* const kernels = HWY_DYNAMIC_DISPATCH(discKernels)();
  return *kernels;
}

const SkeletonKernels<CylinderShape>& kernelsFor(const CylinderShape&)
{
  static const auto* const kernels = HWY_DYNAMIC_DISPATCH(cylinderKernels)();
  return *kernels;
}

const SkeletonKernels<HollowCylinderShape>& kernelsFor(const HollowCylinderShape&)
{
  static const auto* const kernels = HWY_DYNAMIC_DISPATCH(hollowCylinderKernels)();
  return *kernels;
}

const SkeletonKernels<ConeShape>& kernelsFor(const ConeShape&)
{
  static const auto* const kernels = HWY_DYNAMIC_DISPATCH(coneKernels)();
  return *kernels;
}

const SkeletonKernels<ConeSphereShape>& kernelsFor(const ConeSphereShape&)
{
  static const auto* const kernels = HWY_DYNAMIC_DISPATCH(coneSphereKernels)();
  return *kernels;
}

} // namespace hybridtree
#endif
