// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/CurveDistance.h"

#include <cstdint>

// Compiled once per instruction set; what is between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE
// is seen several times.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/CurveKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

using M = hn::Mask<D>;

// One span against one vector of points.
struct SpanMath
{
  const PreparedSpan& span;

  // q and q' at t, whose three lowest coefficients depend on the point.
  HWY_INLINE void slope(const V (&low)[3], V t, V& value, V& derivative) const
  {
    V sum = set(span.selfPower[5]);
    V slopeSum = sum;
    sum = hn::MulAdd(sum, t, set(span.selfPower[4]));
    slopeSum = hn::MulAdd(slopeSum, t, sum);
    sum = hn::MulAdd(sum, t, set(span.selfPower[3]));
    slopeSum = hn::MulAdd(slopeSum, t, sum);
    sum = hn::MulAdd(sum, t, low[2]);
    slopeSum = hn::MulAdd(slopeSum, t, sum);
    sum = hn::MulAdd(sum, t, low[1]);
    slopeSum = hn::MulAdd(slopeSum, t, sum);
    value = hn::MulAdd(sum, t, low[0]);
    derivative = slopeSum;
  }

  HWY_INLINE V along(const Vec3& a, V x, V y, V z) const { return dot(a, x, y, z); }

  // The vector from c(t) to the point.
  HWY_INLINE void offsetAt(V t, V x, V y, V z, V (&out)[3]) const
  {
    const V point[3] = { x, y, z };
    for (int axis = 0; axis < 3; ++axis)
    {
      V sum = hn::MulAdd(set(span.power[3][axis]), t, set(span.power[2][axis]));
      sum = hn::MulAdd(sum, t, set(span.power[1][axis]));
      sum = hn::MulAdd(sum, t, set(span.power[0][axis]));
      out[axis] = hn::Sub(point[axis], sum);
    }
  }

  // The root between 0 and 1 of the lanes in `active`, where q rises through 0 once.
  HWY_INLINE V root(M active, const V (&low)[3], V start) const
  {
    const D d;
    V lower = hn::Zero(d);
    V upper = set(1.0);
    V t = start;
    for (int round = 0; round < 80 && !hn::AllFalse(d, active); ++round)
    {
      V value, derivative;
      this->slope(low, t, value, derivative);
      const M below = hn::Lt(value, hn::Zero(d));
      lower = hn::IfThenElse(below, t, lower);
      upper = hn::IfThenElse(below, upper, t);
      const V newton = hn::Sub(t, hn::Div(value, derivative));
      const M inside = hn::And(hn::Ge(newton, lower), hn::Le(newton, upper));
      const V next = hn::IfThenElse(inside, newton, hn::Mul(set(0.5), hn::Add(lower, upper)));
      const V step = hn::Abs(hn::Sub(next, t));
      // The next step would be the square of this one.
      const M done =
        hn::Or(hn::And(inside, hn::Lt(step, set(1e-9))), hn::Lt(hn::Sub(upper, lower), set(1e-15)));
      t = hn::IfThenElse(active, next, t);
      active = hn::AndNot(done, active);
    }
    return t;
  }

  // \param x, y, z relative to the span's origin.
  HWY_INLINE V nearest(V x, V y, V z) const
  {
    const D d;
    const V zero = hn::Zero(d);
    V tangent[3];
    for (int j = 0; j < 3; ++j)
    {
      tangent[j] = this->along(span.tangent[j], x, y, z);
    }
    V q[6];
    for (int k = 0; k < 6; ++k)
    {
      q[k] = set(span.self[k]);
      for (int j = 0; j < 3; ++j)
      {
        if (PreparedSpan::kElevation[k][j] != 0.0)
        {
          q[k] = hn::NegMulAdd(set(PreparedSpan::kElevation[k][j]), tangent[j], q[k]);
        }
      }
    }
    // No fall from >= 0 to < 0: one minimum, at most. No rise: one maximum, so an end is nearest.
    M falls = hn::MaskFromVec(zero);
    M rises = falls;
    for (int k = 0; k < 5; ++k)
    {
      const M here = hn::Lt(q[k], zero);
      const M next = hn::Lt(q[k + 1], zero);
      falls = hn::Or(falls, hn::AndNot(here, next));
      rises = hn::Or(rises, hn::AndNot(next, here));
    }
    const M first = hn::Lt(q[0], zero);
    const M last = hn::Lt(q[5], zero);
    const M searched = hn::AndNot(falls, hn::AndNot(last, first));

    V ends[3];
    this->offsetAt(zero, x, y, z, ends);
    const V atFirst = squaredNorm(ends[0], ends[1], ends[2]);
    this->offsetAt(set(1.0), x, y, z, ends);
    const V atLast = squaredNorm(ends[0], ends[1], ends[2]);
    V t = hn::IfThenElse(hn::Lt(atLast, atFirst), set(1.0), zero);
    if (!hn::AllFalse(d, searched))
    {
      const V low[3] = {
        hn::Sub(set(span.selfPower[0]), this->along(span.power[1], x, y, z)),
        hn::NegMulAdd(set(2.0), this->along(span.power[2], x, y, z), set(span.selfPower[1])),
        hn::NegMulAdd(set(3.0), this->along(span.power[3], x, y, z), set(span.selfPower[2])),
      };
      const V start = hn::IfThenElse(searched, hn::Div(q[0], hn::Sub(q[0], q[5])), zero);
      t = hn::IfThenElse(searched, this->root(searched, low, start), t);
    }
    const M several = hn::And(falls, rises);
    return hn::AllFalse(d, several) ? t : this->nearestOfSeveral(several, x, y, z, t);
  }

  // Points beyond a centre of curvature, or about as near to several parts of the span.
  V nearestOfSeveral(M several, V x, V y, V z, V t) const
  {
    const D d;
    constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(double);
    HWY_ALIGN double px[kLanes], py[kLanes], pz[kLanes], at[kLanes], chosen[kLanes];
    hn::Store(x, d, px);
    hn::Store(y, d, py);
    hn::Store(z, d, pz);
    hn::Store(t, d, at);
    hn::Store(hn::IfThenElseZero(several, set(1.0)), d, chosen);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    {
      if (chosen[k] != 0.0)
      {
        at[k] = nearestParameter(span, Vec3(px[k], py[k], pz[k]));
      }
    }
    return hn::Load(d, at);
  }
};

struct SpansBody
{
  const PreparedSpan* const* spans;
  std::size_t count;

  // Not above the squared distance of any of the points to the span, but for rounding.
  static HWY_INLINE V squaredToBox(const Box3& box, V x, V y, V z)
  {
    const V zero = hn::Zero(D());
    const V point[3] = { x, y, z };
    V sum = zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      const V out = hn::Max(zero,
        hn::Max(
          hn::Sub(set(box.min()[axis]), point[axis]), hn::Sub(point[axis], set(box.max()[axis]))));
      sum = hn::MulAdd(out, out, sum);
    }
    return sum;
  }

  HWY_INLINE void operator()(
    const double* px, const double* py, const double* pz, const std::array<double*, 3>& out) const
  {
    const D d;
    const V x = hn::LoadU(d, px);
    const V y = hn::LoadU(d, py);
    const V z = hn::LoadU(d, pz);
    V best = set(1e308);
    V bestSpan = best; // by address: candidates come in another order in another batch
    V bestOffset[3] = { best, best, best };
    for (std::size_t k = 0; k < count; ++k)
    {
      const PreparedSpan& span = *spans[k];
      // Rounding of the bound: a little less than the true one.
      const V bound = hn::Mul(set(1.0 - 1e-12), this->squaredToBox(span.box, x, y, z));
      if (hn::AllFalse(d, hn::Le(bound, best)))
      {
        continue;
      }
      const V u = hn::Sub(x, set(span.origin[0]));
      const V v = hn::Sub(y, set(span.origin[1]));
      const V w = hn::Sub(z, set(span.origin[2]));
      const SpanMath math{ span };
      V offset[3];
      math.offsetAt(math.nearest(u, v, w), u, v, w, offset);
      const V squared = squaredNorm(offset[0], offset[1], offset[2]);
      const V here = set(static_cast<double>(reinterpret_cast<std::uintptr_t>(spans[k])));
      const M better =
        hn::Or(hn::Lt(squared, best), hn::And(hn::Eq(squared, best), hn::Lt(here, bestSpan)));
      bestSpan = hn::IfThenElse(better, here, bestSpan);
      best = hn::IfThenElse(better, squared, best);
      for (int axis = 0; axis < 3; ++axis)
      {
        bestOffset[axis] = hn::IfThenElse(better, offset[axis], bestOffset[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      hn::StoreU(bestOffset[axis], d, out[axis]);
    }
  }
};

void nearestOnSpansHere(
  const PreparedSpan* const* spans, std::size_t count, PointBatch points, VectorBatch offset)
{
  forEachVector<3>(points, { offset.x, offset.y, offset.z }, SpansBody{ spans, count });
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(nearestOnSpansHere);

void nearestOnSpans(
  const PreparedSpan* const* spans, std::size_t count, PointBatch points, VectorBatch offset)
{
  HWY_DYNAMIC_DISPATCH(nearestOnSpansHere)(spans, count, points, offset);
}

} // namespace hybridtree
#endif
