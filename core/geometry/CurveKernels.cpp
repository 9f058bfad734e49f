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

  // Where the Bernstein coefficients of q say that it has one minimum, and where it may have
  // several. \param along dot products of the point with the tangent's coefficients.
  struct Search
  {
    M one;
    M several;
    V start; // of Newton's method
  };
  HWY_INLINE Search classify(const V (&along)[3]) const
  {
    const D d;
    const V zero = hn::Zero(d);
    V q[6];
    for (int k = 0; k < 6; ++k)
    {
      q[k] = set(span.self[k]);
      for (int j = 0; j < 3; ++j)
      {
        if (PreparedSpan::kElevation[k][j] != 0.0)
        {
          q[k] = hn::NegMulAdd(set(PreparedSpan::kElevation[k][j]), along[j], q[k]);
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
    const M one = hn::AndNot(falls, hn::AndNot(last, first));
    return { one, hn::And(falls, rises),
      hn::IfThenElseZero(one, hn::Div(q[0], hn::Sub(q[0], q[5]))) };
  }

  HWY_INLINE void alongTangent(V x, V y, V z, V (&out)[3]) const
  {
    for (int j = 0; j < 3; ++j)
    {
      out[j] = dot(span.tangent[j], x, y, z);
    }
  }

  // The coefficients of q that depend on the point.
  HWY_INLINE void lowest(V x, V y, V z, V (&low)[3]) const
  {
    for (int j = 0; j < 3; ++j)
    {
      low[j] = hn::NegMulAdd(set(j + 1.0), dot(span.power[j + 1], x, y, z), set(span.selfPower[j]));
    }
  }

  // Of a thin span. \param x, y, z relative to the span's origin.
  HWY_INLINE V nearest(V x, V y, V z) const
  {
    const D d;
    V ends[3];
    this->offsetAt(hn::Zero(d), x, y, z, ends);
    const V atFirst = squaredNorm(ends[0], ends[1], ends[2]);
    this->offsetAt(set(1.0), x, y, z, ends);
    const V atLast = squaredNorm(ends[0], ends[1], ends[2]);
    V t = hn::IfThenElse(hn::Lt(atLast, atFirst), set(1.0), hn::Zero(d));
    V along[3];
    this->alongTangent(x, y, z, along);
    const Search search = this->classify(along);
    if (!hn::AllFalse(d, search.one))
    {
      V low[3];
      this->lowest(x, y, z, low);
      t = hn::IfThenElse(search.one, this->root(search.one, low, search.start), t);
    }
    return hn::AllFalse(d, search.several)
      ? t
      : this->oneByOne(
          search.several, x, y, z, t, [this](const Vec3& p) { return nearestParameter(span, p); });
  }

  HWY_INLINE V radiusAt(V t) const
  {
    V sum = hn::MulAdd(set(span.radiusPower[3]), t, set(span.radiusPower[2]));
    sum = hn::MulAdd(sum, t, set(span.radiusPower[1]));
    return hn::MulAdd(sum, t, set(span.radiusPower[0]));
  }

  HWY_INLINE V distanceAt(V t, V x, V y, V z) const
  {
    V offset[3];
    this->offsetAt(t, x, y, z, offset);
    return hn::Sub(hn::Sqrt(squaredNorm(offset[0], offset[1], offset[2])), this->radiusAt(t));
  }

  // Of a thick span, as leastThickDistance().
  HWY_INLINE V nearestBall(V x, V y, V z) const
  {
    const D d;
    const V zero = hn::Zero(d);
    const V atFirst = this->distanceAt(zero, x, y, z);
    const V atLast = this->distanceAt(set(1.0), x, y, z);
    V t = hn::IfThenElse(hn::Lt(atLast, atFirst), set(1.0), zero);
    V least = hn::Min(atFirst, atLast);
    V tangent[3];
    V lowest[3];
    this->alongTangent(x, y, z, tangent);
    this->lowest(x, y, z, lowest);
    M several = hn::MaskFromVec(zero);
    M active = hn::Not(several);
    for (int round = 0; round < 30 && !hn::AllFalse(d, active); ++round)
    {
      V along[3];
      V low[3];
      for (int j = 0; j < 3; ++j)
      {
        along[j] = hn::MulAdd(least, set(span.widening[j]), tangent[j]);
        low[j] = hn::NegMulAdd(set((j + 1.0) * span.radiusPower[j + 1]), least, lowest[j]);
      }
      const Search search = this->classify(along);
      several = hn::Or(several, hn::And(active, search.several));
      active = hn::And(active, search.one);
      if (hn::AllFalse(d, active))
      {
        break;
      }
      const V at = this->root(active, low, search.start);
      const V here = this->distanceAt(at, x, y, z);
      const V rounding = hn::Mul(set(1e-15), hn::Add(hn::Abs(least), set(span.radius[0])));
      const M better = hn::And(active, hn::Lt(here, least));
      active = hn::And(better, hn::Gt(hn::Sub(least, here), rounding));
      t = hn::IfThenElse(better, at, t);
      least = hn::IfThenElse(better, here, least);
    }
    return hn::AllFalse(d, several) ? t
                                    : this->oneByOne(several, x, y, z, t,
                                        [this](const Vec3& p)
                                        {
                                          double at;
                                          leastThickDistance(span, p, at);
                                          return at;
                                        });
  }

  // Points beyond a centre of curvature, or about as near to several parts of the span.
  template <class Parameter>
  V oneByOne(M chosen, V x, V y, V z, V t, const Parameter& parameter) const
  {
    const D d;
    constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(double);
    HWY_ALIGN double px[kLanes], py[kLanes], pz[kLanes], at[kLanes], isChosen[kLanes];
    hn::Store(x, d, px);
    hn::Store(y, d, py);
    hn::Store(z, d, pz);
    hn::Store(t, d, at);
    hn::Store(hn::IfThenElseZero(chosen, set(1.0)), d, isChosen);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    {
      if (isChosen[k] != 0.0)
      {
        at[k] = parameter(Vec3(px[k], py[k], pz[k]));
      }
    }
    return hn::Load(d, at);
  }
};

// Of several spans the nearest one: by the squared distance, or by the distance to the balls.
template <bool Thick>
struct SpansBody
{
  static constexpr std::size_t kOutputs = Thick ? 4 : 3;

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

  // Whether the span may be nearer than `best` to some point. Rounding of the bound: a little less
  // than the true one.
  static HWY_INLINE bool mayBeNearer(const PreparedSpan& span, V x, V y, V z, V best)
  {
    const D d;
    const V toBox = squaredToBox(span.box, x, y, z);
    if constexpr (Thick)
    {
      const V toCenter = hn::Sqrt(toBox);
      const V radius = set(span.largestRadius);
      const V slack = hn::Mul(set(1e-12), hn::Add(toCenter, hn::Abs(radius)));
      return !hn::AllFalse(d, hn::Le(hn::Sub(hn::Sub(toCenter, radius), slack), best));
    }
    else
    {
      return !hn::AllFalse(d, hn::Le(hn::Mul(set(1.0 - 1e-12), toBox), best));
    }
  }

  HWY_INLINE void operator()(const double* px, const double* py, const double* pz,
    const std::array<double*, kOutputs>& out) const
  {
    const D d;
    const V x = hn::LoadU(d, px);
    const V y = hn::LoadU(d, py);
    const V z = hn::LoadU(d, pz);
    V best = set(1e308);
    V bestSpan = best; // by address: candidates come in another order in another batch
    V bestOffset[4] = { best, best, best, hn::Zero(d) };
    for (std::size_t k = 0; k < count; ++k)
    {
      const PreparedSpan& span = *spans[k];
      if (!mayBeNearer(span, x, y, z, best))
      {
        continue;
      }
      const V u = hn::Sub(x, set(span.origin[0]));
      const V v = hn::Sub(y, set(span.origin[1]));
      const V w = hn::Sub(z, set(span.origin[2]));
      const SpanMath math{ span };
      const V t = Thick ? math.nearestBall(u, v, w) : math.nearest(u, v, w);
      V offset[3];
      math.offsetAt(t, u, v, w, offset);
      const V squared = squaredNorm(offset[0], offset[1], offset[2]);
      const V radius = Thick ? math.radiusAt(t) : hn::Zero(d);
      const V value = Thick ? hn::Sub(hn::Sqrt(squared), radius) : squared;
      const V here = set(static_cast<double>(reinterpret_cast<std::uintptr_t>(spans[k])));
      const M better =
        hn::Or(hn::Lt(value, best), hn::And(hn::Eq(value, best), hn::Lt(here, bestSpan)));
      bestSpan = hn::IfThenElse(better, here, bestSpan);
      best = hn::IfThenElse(better, value, best);
      for (int axis = 0; axis < 3; ++axis)
      {
        bestOffset[axis] = hn::IfThenElse(better, offset[axis], bestOffset[axis]);
      }
      bestOffset[3] = hn::IfThenElse(better, radius, bestOffset[3]);
    }
    for (std::size_t k = 0; k < kOutputs; ++k)
    {
      hn::StoreU(bestOffset[k], d, out[k]);
    }
  }
};

void nearestOnSpansHere(
  const PreparedSpan* const* spans, std::size_t count, PointBatch points, VectorBatch offset)
{
  forEachVector<3>(points, { offset.x, offset.y, offset.z }, SpansBody<false>{ spans, count });
}

void nearestOnThickSpansHere(const PreparedSpan* const* spans, std::size_t count, PointBatch points,
  VectorBatch offset, double* radius)
{
  forEachVector<4>(
    points, { offset.x, offset.y, offset.z, radius }, SpansBody<true>{ spans, count });
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(nearestOnSpansHere);
HWY_EXPORT(nearestOnThickSpansHere);

void nearestOnSpans(
  const PreparedSpan* const* spans, std::size_t count, PointBatch points, VectorBatch offset)
{
  HWY_DYNAMIC_DISPATCH(nearestOnSpansHere)(spans, count, points, offset);
}

void nearestOnThickSpans(const PreparedSpan* const* spans, std::size_t count, PointBatch points,
  VectorBatch offset, double* radius)
{
  HWY_DYNAMIC_DISPATCH(nearestOnThickSpansHere)(spans, count, points, offset, radius);
}

} // namespace hybridtree
#endif
