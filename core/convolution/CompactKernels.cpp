// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

#include <type_traits>

// Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/convolution/CompactKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/convolution/ElementSums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// Integral of (q - y^2)^n over y from y0 to y1. Exponent 0 means: known only at run time.
template <int Exponent>
struct CompactSegmentIntegral
{
  int exponent;

  explicit CompactSegmentIntegral(const ConvolutionKernel& kernel)
    : exponent(Exponent == 0 ? kernel.exponent : Exponent)
  {
  }

  struct Result
  {
    V integral;   // with exponent n
    V lower;      // with exponent n - 1
    V start, end; // the integrand at both ends, 0 where the reach cuts it off
  };

  HWY_INLINE bool integrate(const SegmentView& view, Result& result) const
  {
    const V zero = hn::Zero(D());
    const V root = hn::Sqrt(hn::Max(view.q, zero));
    const V low = hn::Max(view.y0, hn::Neg(root));
    V high = hn::Min(view.y1, root);
    const auto reached = hn::Lt(low, high);
    if (hn::AllFalse(D(), reached))
    {
      return false;
    }
    high = hn::IfThenElse(reached, high, low);
    const V start = hn::IfThenElseZero(reached, hn::Max(zero, hn::NegMulAdd(low, low, view.q)));
    const V end = hn::IfThenElseZero(reached, hn::Max(zero, hn::NegMulAdd(high, high, view.q)));
    V startPower = set(1.0);
    V endPower = startPower;
    result.integral = hn::Sub(high, low);
    result.lower = result.integral;
    // (2k + 1) I_k = [y (q - y^2)^k] + 2 k q I_(k-1): all terms of one sign about y = 0.
    for (int k = 1; k <= exponent; ++k)
    {
      result.lower = result.integral;
      startPower = hn::Mul(startPower, start);
      endPower = hn::Mul(endPower, end);
      const V edge = hn::MulSub(high, endPower, hn::Mul(low, startPower));
      result.integral = hn::Mul(
        hn::MulAdd(hn::Mul(set(2.0 * k), view.q), result.lower, edge), set(1.0 / (2 * k + 1)));
    }
    result.start = startPower;
    result.end = endPower;
    return true;
  }

  HWY_INLINE void add(const SegmentElement& element, V x, V y, V z, V& value) const
  {
    if (areBeyond(element.ball, x, y, z))
    {
      return;
    }
    Result result;
    if (this->integrate(SegmentView(element, x, y, z), result))
    {
      value = hn::Add(value, result.integral);
    }
  }

  HWY_INLINE void addWithGradient(
    const SegmentElement& element, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const
  {
    if (areBeyond(element.ball, x, y, z))
    {
      return;
    }
    const SegmentView view(element, x, y, z);
    Result result;
    if (this->integrate(view, result))
    {
      value = hn::Add(value, result.integral);
      addSegmentGradient(element, view,
        { hn::Mul(set(exponent), result.lower), hn::Neg(result.start), result.end }, gx, gy, gz);
    }
  }
};

// Integral of (q - |y|^2)^n over the part of a triangle inside the disc |y|^2 < q.
//
// In polar coordinates about the origin the inner integral is [q^(n+1) - (q - rho^2)^(n+1)] /
// (2 (n + 1)), rho the way to the edge, or q^(n+1) / (2 (n + 1)) where the disc ends before. On an
// edge at signed distance delta, l along it, X = delta^2 + l^2, dtheta = delta dl / X, and
// [q^(n+1) - (q - X)^(n+1)] / X = sum of q^k (q - X)^(n-k): so within the disc a polynomial in l,
// without any angle, and good at delta = 0; outside, the angle that the rest of the edge covers.
template <int Exponent>
struct CompactTriangleIntegral
{
  int exponent;

  explicit CompactTriangleIntegral(const ConvolutionKernel& kernel)
    : exponent(Exponent == 0 ? kernel.exponent : Exponent)
  {
  }

  struct Edge : TriangleEdge
  {
    V low, high; // the part within the disc; equal where there is none

    HWY_INLINE Edge(const TriangleElement& element, const TriangleView& view, std::size_t k, V root)
      : TriangleEdge(element, view, k)
    {
      const V half =
        hn::Sqrt(hn::Max(hn::Zero(D()), hn::Mul(hn::Sub(root, distance), hn::Add(root, distance))));
      low = hn::Min(hn::Max(start, hn::Neg(half)), half);
      high = hn::Min(hn::Max(end, hn::Neg(half)), half);
    }
  };

  struct Result
  {
    V integral;
    V lower; // with exponent n - 1
  };

  // Integrals over the part of an edge within the disc.
  struct EdgeSums
  {
    V sum;      // of q^k I_(n-k), I_j the integral of (q - delta^2 - l^2)^j
    V lowerSum; // with n - 1
    V zeroth;   // I_n
    V first;    // integral of l (q - delta^2 - l^2)^n
  };

  HWY_INLINE EdgeSums integrateEdge(const Edge& edge, V q) const
  {
    const V zero = hn::Zero(D());
    const V rest = hn::NegMulAdd(edge.distance, edge.distance, q);
    const V low = hn::Max(zero, hn::NegMulAdd(edge.low, edge.low, rest));
    const V high = hn::Max(zero, hn::NegMulAdd(edge.high, edge.high, rest));
    V lowPower = set(1.0);
    V highPower = lowPower;
    EdgeSums sums;
    sums.zeroth = hn::Sub(edge.high, edge.low);
    sums.sum = sums.zeroth;
    sums.lowerSum = sums.sum;
    for (int k = 1; k <= exponent; ++k)
    {
      lowPower = hn::Mul(lowPower, low);
      highPower = hn::Mul(highPower, high);
      const V ends = hn::MulSub(edge.high, highPower, hn::Mul(edge.low, lowPower));
      sums.zeroth =
        hn::Mul(hn::MulAdd(hn::Mul(set(2.0 * k), rest), sums.zeroth, ends), set(1.0 / (2 * k + 1)));
      sums.lowerSum = sums.sum;
      sums.sum = hn::MulAdd(q, sums.sum, sums.zeroth);
    }
    sums.first =
      hn::Mul(hn::MulSub(lowPower, low, hn::Mul(highPower, high)), set(0.5 / (exponent + 1)));
    return sums;
  }

  // The angles at the origin that parts of edges outside of the disc cover, as the argument of a
  // product of complex numbers: one angle() for all.
  struct OuterAngle
  {
    V x, y;

    HWY_INLINE OuterAngle() : x(set(1.0)), y(hn::Zero(D())) {}

    HWY_INLINE void add(const Edge& edge)
    {
      this->turn(edge.distance, edge.end, edge.high);
      this->turn(edge.distance, edge.low, edge.start);
    }

    // Together the angle of the circle's arcs inside of the triangle, so none below 0. \param
    // isWhole where that is the whole circle: elsewhere 1e-8 of it are missing at least.
    template <class M>
    HWY_INLINE V sum(M isWhole) const
    {
      const V zero = hn::Zero(D());
      if (hn::AllTrue(D(), hn::And(hn::Eq(x, set(1.0)), hn::Eq(y, zero))))
      {
        return zero; // all of the triangle is in the disc
      }
      const V full = set(4.0 * kNumbers.halfPi);
      const V angle = angleOf(x, hn::Abs(y));
      V sum = hn::IfThenElse(hn::Lt(y, zero), hn::Sub(full, angle), angle);
      sum = hn::IfThenElseZero(hn::Lt(sum, set(4.0 * kNumbers.halfPi - 1e-9)), sum);
      return hn::IfThenElse(isWhole, full, sum);
    }

  private:
    // From `from` to `to` on the same side of the foot of the origin, at most a quarter.
    HWY_INLINE void turn(V distance, V to, V from)
    {
      const auto isOutside = hn::Ne(to, from);
      const V one = set(1.0);
      const V cosine =
        hn::IfThenElse(isOutside, hn::MulAdd(distance, distance, hn::Mul(to, from)), one);
      const V sine = hn::Mul(distance, hn::Sub(to, from));
      const V before = x;
      x = hn::MulSub(before, cosine, hn::Mul(y, sine));
      y = hn::MulAdd(before, sine, hn::Mul(y, cosine));
    }
  };

  // \param slopes null, or derivatives by the corners to be written.
  HWY_INLINE bool integrate(TriangleView& view, const TriangleElement& element, Result& result,
    TriangleSlopes* slopes) const
  {
    const D d;
    const V zero = hn::Zero(d);
    if (hn::AllFalse(d, hn::Gt(view.q, zero)))
    {
      return false;
    }
    view.placeCorners(element);
    const V q = hn::Max(zero, view.q);
    const V root = hn::Sqrt(q);
    const Edge edges[3] = { Edge(element, view, 0, root), Edge(element, view, 1, root),
      Edge(element, view, 2, root) };
    // Within the disc: the whole triangle around its center, or a part of an edge.
    const V nearest = hn::Min(edges[0].distance, hn::Min(edges[1].distance, edges[2].distance));
    auto reached = hn::Gt(nearest, zero);
    for (const Edge& edge : edges)
    {
      reached = hn::Or(reached, hn::Lt(edge.low, edge.high));
    }
    reached = hn::And(reached, hn::Gt(q, zero));
    if (hn::AllFalse(d, reached))
    {
      return false;
    }
    const V lowerPower = power<Exponent>(q, exponent);
    const V fullPower = hn::Mul(lowerPower, q);
    V sum = zero;
    V lowerSum = zero;
    OuterAngle outer;
    if (slopes)
    {
      slopes->u = slopes->v = { zero, zero, zero };
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Edge& edge = edges[k];
      const EdgeSums sums = this->integrateEdge(edge, q);
      outer.add(edge);
      sum = hn::MulAdd(edge.distance, sums.sum, sum);
      if (!slopes)
      {
        continue;
      }
      lowerSum = hn::MulAdd(edge.distance, sums.lowerSum, lowerSum);
      edge.addSlopes(k, hn::IfThenElseZero(reached, sums.zeroth),
        hn::IfThenElseZero(reached, sums.first), *slopes);
    }
    const V arcs = outer.sum(hn::Ge(nearest, root));
    sum = hn::MulAdd(fullPower, arcs, sum);
    result.integral =
      hn::IfThenElseZero(reached, hn::Max(zero, hn::Mul(sum, set(0.5 / (exponent + 1)))));
    if (slopes)
    {
      lowerSum = hn::MulAdd(lowerPower, arcs, lowerSum);
      result.lower =
        hn::IfThenElseZero(reached, hn::Max(zero, hn::Mul(lowerSum, set(0.5 / exponent))));
    }
    return true;
  }

  HWY_INLINE void add(const TriangleElement& element, V x, V y, V z, V& value) const
  {
    if (areBeyond(element.ball, x, y, z))
    {
      return;
    }
    TriangleView view(element, x, y, z);
    Result result;
    if (this->integrate(view, element, result, nullptr))
    {
      value = hn::Add(value, result.integral);
    }
  }

  HWY_INLINE void addWithGradient(
    const TriangleElement& element, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const
  {
    if (areBeyond(element.ball, x, y, z))
    {
      return;
    }
    TriangleView view(element, x, y, z);
    Result result;
    TriangleSlopes slopes;
    if (this->integrate(view, element, result, &slopes))
    {
      value = hn::Add(value, result.integral);
      slopes.q = hn::Mul(set(exponent), result.lower);
      addTriangleGradient(element, view, slopes, gx, gy, gz);
    }
  }
};

// use() with the exponent as a constant where it is a common one.
template <typename Use>
void withExponent(const ConvolutionKernel& kernel, const Use& use)
{
  switch (kernel.exponent)
  {
    case 2:
      use(std::integral_constant<int, 2>());
      break;
    case 3:
      use(std::integral_constant<int, 3>());
      break;
    default:
      use(std::integral_constant<int, 0>());
  }
}

template <class Element, template <int> class Integral>
struct CompactSums
{
  static void add(
    ElementSpan<Element> span, const ConvolutionKernel& kernel, PointBatch points, double* sum)
  {
    withExponent(
      kernel, [&](auto n) { ElementSums<Element, Integral<n()>>::add(span, kernel, points, sum); });
  }
  static void addWithGradient(ElementSpan<Element> span, const ConvolutionKernel& kernel,
    PointBatch points, double* sum, VectorBatch gradient)
  {
    withExponent(kernel,
      [&](auto n) {
        ElementSums<Element, Integral<n()>>::addWithGradient(span, kernel, points, sum, gradient);
      });
  }
  static void rows(const PieceElements<Element>& pieces, const ConvolutionKernel& kernel,
    PointBatch points, const ElementRows& to)
  {
    withExponent(kernel,
      [&](auto n) { ElementSums<Element, Integral<n()>>::rows(pieces, kernel, points, to); });
  }
};

struct CompactSharedSums
{
  template <int Exponent>
  using Sums = SharedSums<CompactSegmentIntegral<Exponent>, CompactTriangleIntegral<Exponent>>;

  static void add(const std::vector<SharedElements>& parts, const ConvolutionKernel& kernel,
    PointBatch points, double* sum)
  {
    withExponent(kernel, [&](auto n) { Sums<n()>::add(parts, kernel, points, sum); });
  }
  static void addWithGradient(const std::vector<SharedElements>& parts,
    const ConvolutionKernel& kernel, PointBatch points, double* sum, VectorBatch gradient)
  {
    withExponent(
      kernel, [&](auto n) { Sums<n()>::addWithGradient(parts, kernel, points, sum, gradient); });
  }
};

const ConvolutionKernels* compactKernels()
{
  return kernelsOf<CompactSums<SegmentElement, CompactSegmentIntegral>,
    CompactSums<TriangleElement, CompactTriangleIntegral>, CompactSharedSums>();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(compactKernels);

const ConvolutionKernels& compactConvolutionKernels()
{
  static const ConvolutionKernels* const kernels = HWY_DYNAMIC_DISPATCH(compactKernels)();
  return *kernels;
}

} // namespace hybridtree
#endif
