// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/PlateKernels.h"

// Compiled once per instruction set, as SkeletonKernels.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/PlateKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

struct PlateMath
{
  HWY_INLINE explicit PlateMath(const PlateShape& plate)
    : origin(plate.origin)
    , axes(plate.axes)
    , begin(plate.sides.data())
    , end(begin + plate.sides.size())
  {
  }

  Vec3 origin;
  Mat3 axes;
  const PlateShape::Side* begin;
  const PlateShape::Side* end;

  // In the frame of the plate: the vector from its nearest point.
  HWY_INLINE void localOffset(V& x, V& y, V& z) const
  {
    const V px = hn::Sub(x, set(origin[0]));
    const V py = hn::Sub(y, set(origin[1]));
    const V pz = hn::Sub(z, set(origin[2]));
    const V u = dot(axes.col(0), px, py, pz);
    const V v = dot(axes.col(1), px, py, pz);
    z = dot(axes.col(2), px, py, pz);

    const D d;
    const V zero = hn::Zero(d);
    const V one = set(1.0);
    V least = set(1e308);
    auto inside = hn::Lt(least, zero);
    for (const PlateShape::Side* side = begin; side != end; ++side)
    {
      const V fromX = hn::Sub(u, set(side->x));
      const V fromY = hn::Sub(v, set(side->y));
      const V along = hn::Mul(hn::MulAdd(set(side->dx), fromX, hn::Mul(set(side->dy), fromY)),
        set(side->inverseSquaredLength));
      const V foot = hn::Min(one, hn::Max(zero, along));
      const V offX = hn::NegMulAdd(foot, set(side->dx), fromX);
      const V offY = hn::NegMulAdd(foot, set(side->dy), fromY);
      const V squared = hn::MulAdd(offX, offX, hn::Mul(offY, offY));
      const auto nearer = hn::Lt(squared, least);
      least = hn::IfThenElse(nearer, squared, least);
      x = hn::IfThenElse(nearer, offX, x);
      y = hn::IfThenElse(nearer, offY, y);
      // Parity of the sides that a ray towards +x crosses. Both ends are compared with the same
      // numbers by the two sides they belong to, so no corner is counted twice or missed.
      const PlateShape::Side* next = side + 1 == end ? begin : side + 1;
      const auto crosses = hn::Xor(hn::Gt(set(side->y), v), hn::Gt(set(next->y), v));
      const auto toTheRight = hn::Lt(fromX, hn::Mul(fromY, set(side->slope)));
      inside = hn::Xor(inside, hn::And(crosses, toTheRight));
    }
    x = hn::IfThenElse(inside, zero, x);
    y = hn::IfThenElse(inside, zero, y);
  }
  HWY_INLINE void offset(V& x, V& y, V& z) const
  {
    this->localOffset(x, y, z);
    const V u = x;
    const V v = y;
    const V w = z;
    x = dot(axes.row(0).transpose(), u, v, w);
    y = dot(axes.row(1).transpose(), u, v, w);
    z = dot(axes.row(2).transpose(), u, v, w);
  }
  HWY_INLINE V squared(V x, V y, V z) const
  {
    this->localOffset(x, y, z);
    return squaredNorm(x, y, z);
  }
  HWY_INLINE V signedDistance(V x, V y, V z) const { return hn::Sqrt(this->squared(x, y, z)); }
};

const SkeletonKernels<PlateShape>* plateKernels()
{
  return Kernels<PlateShape, PlateMath>::table();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(plateKernels);

PlateShape makePlate(
  const Vec3& origin, const Mat3& axes, const std::vector<Eigen::Vector2d>& corners)
{
  PlateShape plate{ origin, axes, {} };
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Eigen::Vector2d& a = corners[k];
    const Eigen::Vector2d edge = corners[(k + 1) % corners.size()] - a;
    plate.sides.push_back({ a.x(), a.y(), edge.x(), edge.y(), 1.0 / edge.squaredNorm(),
      edge.y() != 0.0 ? edge.x() / edge.y() : 0.0 });
  }
  return plate;
}

const SkeletonKernels<PlateShape>& kernelsFor(const PlateShape&)
{
  static const SkeletonKernels<PlateShape>* const kernels = HWY_DYNAMIC_DISPATCH(plateKernels)();
  return *kernels;
}

} // namespace hybridtree
#endif
