// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ShareKernels.h"

// Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/convolution/ShareKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

void addScaled(const double* from, std::size_t size, const ScaledRow* to, std::size_t count)
{
  const D d;
  for (std::size_t at = 0; at < size; at += hn::Lanes(d))
  {
    const V value = hn::LoadU(d, from + at);
    for (std::size_t k = 0; k < count; ++k)
    {
      double* sum = to[k].row + at;
      hn::StoreU(hn::MulAdd(set(to[k].scale), value, hn::LoadU(d, sum)), d, sum);
    }
  }
}

// Of `Count` columns.
template <std::size_t Count>
HWY_INLINE void addColumns(const double* row, std::size_t stride, std::size_t count,
  const double* weights, std::size_t columns, double scale, std::size_t at, const ProductColumn* to)
{
  const D d;
  V sum[Count];
  for (V& of : sum)
  {
    of = hn::Zero(d);
  }
  for (std::size_t k = 0; k < count; ++k, row += stride, weights += columns)
  {
    const V value = hn::LoadU(d, row);
    for (std::size_t n = 0; n < Count; ++n)
    {
      sum[n] = hn::MulAdd(set(weights[to[n].column]), value, sum[n]);
    }
  }
  for (std::size_t n = 0; n < Count; ++n)
  {
    double* result = to[n].row + at;
    hn::StoreU(hn::MulAdd(set(scale), sum[n], hn::LoadU(d, result)), d, result);
  }
}

void addProducts(const double* from, std::size_t stride, std::size_t count, const double* weights,
  std::size_t columns, double scale, std::size_t size, const ProductColumn* to, std::size_t wanted)
{
  constexpr std::size_t kBlock = 4;
  for (std::size_t at = 0; at < size; at += hn::Lanes(D()))
  {
    std::size_t n = 0;
    for (; n + kBlock <= wanted; n += kBlock)
    {
      addColumns<kBlock>(from + at, stride, count, weights, columns, scale, at, to + n);
    }
    for (; n < wanted; ++n)
    {
      addColumns<1>(from + at, stride, count, weights, columns, scale, at, to + n);
    }
  }
}

bool findShares(double begin, double farthest, std::size_t size, const ShareRows& rows)
{
  const D d;
  const V zero = hn::Zero(d);
  const V one = set(1.0);
  V steepest = zero;
  for (std::size_t at = 0; at < size; at += hn::Lanes(d))
  {
    const V sum = hn::LoadU(d, rows.sum + at);
    const V inverse = hn::IfThenElseZero(hn::Gt(sum, zero), hn::Div(one, sum));
    const V near = hn::Mul(hn::LoadU(d, rows.near + at), inverse);
    const V x = hn::Min(hn::Max(hn::Sub(set(farthest - begin), near), zero), one);
    const V square = hn::Mul(x, x);
    const V inner = hn::MulAdd(x, hn::MulAdd(x, set(6.0), set(-15.0)), set(10.0));
    const V share = hn::NegMulAdd(hn::Mul(square, x), inner, one);
    const V rest = hn::Sub(one, x);
    const V slope = hn::Mul(hn::Mul(set(-30.0), square), hn::Mul(rest, rest));
    const V own = hn::LoadU(d, rows.own + at);
    const V step = hn::Mul(hn::Mul(own, inverse), slope);
    steepest = hn::Min(steepest, step);
    hn::StoreU(share, d, rows.share + at);
    hn::StoreU(step, d, rows.step + at);
    hn::StoreU(hn::MulAdd(share, own, hn::LoadU(d, rows.total + at)), d, rows.total + at);
    hn::StoreU(hn::MulAdd(step, near, hn::LoadU(d, rows.shift + at)), d, rows.shift + at);
  }
  return !hn::AllTrue(d, hn::Eq(steepest, zero));
}

void addGradient(const double* share, const double* shift, const ScaledRow* steps,
  std::size_t count, std::size_t size, const double* gradient, std::size_t stride, double* to)
{
  const D d;
  for (std::size_t at = 0; at < size; at += hn::Lanes(d))
  {
    V weight = hn::Add(hn::LoadU(d, share + at), hn::LoadU(d, shift + at));
    for (std::size_t k = 0; k < count; ++k)
    {
      weight = hn::NegMulAdd(set(steps[k].scale), hn::LoadU(d, steps[k].row + at), weight);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double* sum = to + axis * stride + at;
      const V slope = hn::LoadU(d, gradient + axis * stride + at);
      hn::StoreU(hn::MulAdd(weight, slope, hn::LoadU(d, sum)), d, sum);
    }
  }
}

const ShareKernels* kernels()
{
  static const ShareKernels kernels = { &addScaled, &addProducts, &findShares, &addGradient };
  return &kernels;
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(kernels);

const ShareKernels& shareKernels()
{
  static const ShareKernels* const best = HWY_DYNAMIC_DISPATCH(kernels)();
  return *best;
}

} // namespace hybridtree
#endif
