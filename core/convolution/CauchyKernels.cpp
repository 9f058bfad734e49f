// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

// Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/convolution/CauchyKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/convolution/ElementSums-inl.h"

// With 1 - d^2/R^2 = q - y^2 the kernel is 1 / (a + 4 y^2)^2, a = 5 - 4 q >= 1.
HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// Integrals of 1 / B and 1 / B^2 and more, B = a + 4 l^2, between two ends of a line.
struct CauchyLine
{
  V first, second;         // 1 / B at both ends
  V single, twice, thrice; // integrals of 1 / B, 1 / B^2, 1 / B^3

  /// \pre a >= 1; low <= high.
  HWY_INLINE CauchyLine(V a, V low, V high)
  {
    const V four = set(kNumbers.four);
    // One division for three; so far away that their product ends all is 0 in any case.
    const V farthest = set(kNumbers.farthest);
    const V middle = hn::Min(a, farthest);
    const V atLow = hn::Min(hn::MulAdd(hn::Mul(four, low), low, a), farthest);
    const V atHigh = hn::Min(hn::MulAdd(hn::Mul(four, high), high, a), farthest);
    const V product = hn::Mul(atLow, atHigh);
    const V inverses = hn::Div(set(kNumbers.one), hn::Mul(product, middle));
    const V inverse = hn::Mul(inverses, product);
    first = hn::Mul(inverses, hn::Mul(atHigh, middle));
    second = hn::Mul(inverses, hn::Mul(atLow, middle));
    // (atan(high s) - atan(low s)) / s, s = 2 / sqrt(a).
    const V root = hn::Sqrt(middle);
    const V half = hn::Mul(set(kNumbers.half), hn::Mul(root, inverse));
    single = hn::Mul(half,
      angleOf(hn::MulAdd(hn::Mul(four, low), high, middle),
        hn::Mul(hn::Add(root, root), hn::Max(hn::Sub(high, low), hn::Zero(D())))));
    const V ends = hn::MulSub(high, second, hn::Mul(low, first));
    twice = hn::Mul(hn::Mul(set(kNumbers.half), inverse), hn::Add(ends, single));
    const V squares =
      hn::MulSub(hn::Mul(high, second), second, hn::Mul(hn::Mul(low, first), first));
    thrice = hn::Mul(
      hn::Mul(set(kNumbers.quarter), inverse), hn::MulAdd(set(kNumbers.three), twice, squares));
  }
};

struct CauchySegmentIntegral
{
  explicit CauchySegmentIntegral(const ConvolutionKernel&) {}

  HWY_INLINE void add(const SegmentElement& element, V x, V y, V z, V& value) const
  {
    const SegmentView view(element, x, y, z);
    value = hn::Add(value, lineOf(view).twice);
  }

  HWY_INLINE void addWithGradient(
    const SegmentElement& element, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const
  {
    const SegmentView view(element, x, y, z);
    const CauchyLine line = lineOf(view);
    value = hn::Add(value, line.twice);
    addSegmentGradient(element, view,
      { hn::Mul(set(kNumbers.eight), line.thrice), hn::Neg(hn::Mul(line.first, line.first)),
        hn::Mul(line.second, line.second) },
      gx, gy, gz);
  }

private:
  static HWY_INLINE CauchyLine lineOf(const SegmentView& view)
  {
    return CauchyLine(
      hn::NegMulAdd(set(kNumbers.four), view.q, set(kNumbers.five)), view.y0, view.y1);
  }
};

// In polar coordinates about the origin, as the compact kernel's: on an edge at distance delta,
// X = delta^2 + l^2, the inner integral over dtheta = delta dl / X gives delta / (2 a) times that
// of 1 / (a + 4 X).
struct CauchyTriangleIntegral
{
  explicit CauchyTriangleIntegral(const ConvolutionKernel&) {}

  HWY_INLINE void add(const TriangleElement& element, V x, V y, V z, V& value) const
  {
    V gx = hn::Zero(D());
    V gy = gx;
    V gz = gx;
    this->sum<false>(element, x, y, z, value, gx, gy, gz);
  }

  HWY_INLINE void addWithGradient(
    const TriangleElement& element, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const
  {
    this->sum<true>(element, x, y, z, value, gx, gy, gz);
  }

private:
  template <bool WithGradient>
  HWY_INLINE void sum(
    const TriangleElement& element, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const
  {
    const V zero = hn::Zero(D());
    TriangleView view(element, x, y, z);
    view.placeCorners(element);
    const V a = hn::NegMulAdd(set(4.0), view.q, set(5.0));
    const V inverse = hn::Div(set(1.0), a);
    V integral = zero;
    TriangleSlopes slopes{ zero, { zero, zero, zero }, { zero, zero, zero } };
    for (std::size_t k = 0; k < 3; ++k)
    {
      const TriangleEdge edge(element, view, k);
      const V level = hn::MulAdd(hn::Mul(set(4.0), edge.distance), edge.distance, a);
      const CauchyLine line(level, edge.start, edge.end);
      integral = hn::MulAdd(edge.distance, line.single, integral);
      if (WithGradient)
      {
        const V inner = hn::MulAdd(inverse, line.single, line.twice);
        slopes.q = hn::MulAdd(edge.distance, inner, slopes.q);
        const V moment = hn::Mul(set(0.125), hn::Sub(line.first, line.second));
        edge.addSlopes(k, line.twice, moment, slopes);
      }
    }
    value = hn::MulAdd(hn::Mul(set(0.5), inverse), integral, value);
    if (WithGradient)
    {
      slopes.q = hn::Mul(hn::Add(inverse, inverse), slopes.q);
      addTriangleGradient(element, view, slopes, gx, gy, gz);
    }
  }
};

const ConvolutionKernels* cauchyKernels()
{
  return kernelsOf<ElementSums<SegmentElement, CauchySegmentIntegral>,
    ElementSums<TriangleElement, CauchyTriangleIntegral>,
    SharedSums<CauchySegmentIntegral, CauchyTriangleIntegral>>();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(cauchyKernels);

const ConvolutionKernels& cauchyConvolutionKernels()
{
  static const ConvolutionKernels* const kernels = HWY_DYNAMIC_DISPATCH(cauchyKernels)();
  return *kernels;
}

} // namespace hybridtree
#endif
