// SPDX-License-Identifier: BSD-3-Clause
// The geometry of elements in the coordinates in which kernels are polynomials (see
// ConvolutionElement.h). Included once per instruction set; so no #pragma once.
#if defined(HYBRIDTREE_CONVOLUTION_KERNELS) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_CONVOLUTION_KERNELS
#undef HYBRIDTREE_CONVOLUTION_KERNELS
#else
#define HYBRIDTREE_CONVOLUTION_KERNELS
#endif

#include "core/convolution/ConvolutionKernels.h"
#include "core/geometry/SkeletonKernels-inl.h"

#include <array>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// Keeps 1 / (R_p^2 + slope^2 h^2) finite at the one point where it is 0.
constexpr double kSmallestSquare = 1e-280;

// The angle of (x, y) to the first axis, y >= 0: 0 to pi, as atan2(y, x) within 3e-16. One
// division, where differences of arcus tangents take one for each of these and more within them.
HWY_INLINE V angleOf(V x, V y)
{
  // Even and odd powers by themselves: half as long a chain.
  const auto& even = kNumbers.evenPowers;
  const auto& odd = kNumbers.oddPowers;
  const V across = hn::Abs(x);
  const auto isSteep = hn::Gt(y, across);
  const V larger = hn::Max(hn::Max(y, across), set(1e-300));
  const V t = hn::Div(hn::Min(y, across), larger);
  const V square = hn::Mul(t, t);
  const V fourth = hn::Mul(square, square);
  V evenSum = set(even[9]);
  V oddSum = set(odd[9]);
  for (int k = 8; k >= 0; --k)
  {
    evenSum = hn::MulAdd(evenSum, fourth, set(even[k]));
    oddSum = hn::MulAdd(oddSum, fourth, set(odd[k]));
  }
  V angle = hn::Mul(t, hn::MulAdd(oddSum, square, evenSum));
  const V quarterTurn = set(kNumbers.halfPi);
  angle = hn::IfThenElse(isSteep, hn::Sub(quarterTurn, angle), angle);
  return hn::IfThenElse(
    hn::Lt(x, hn::Zero(D())), hn::Sub(hn::Add(quarterTurn, quarterTurn), angle), angle);
}

// Whether no point is within an element's ball.
HWY_INLINE bool areBeyond(const ElementBall& ball, V x, V y, V z)
{
  const V squared = squaredNorm(hn::Sub(x, set(ball.center[0])), hn::Sub(y, set(ball.center[1])),
    hn::Sub(z, set(ball.center[2])));
  return hn::AllFalse(D(), hn::Lt(squared, set(ball.squaredRadius)));
}

// A point seen from the line of a segment: 1 - d^2/R^2 = q - y^2 along it, y from y0 to y1.
struct SegmentView
{
  V along;         // coordinate of the projection, from the start
  V px, py, pz;    // from the projection to the point
  V squaredHeight; // of that
  V reach;         // R at the projection
  V inverseScale;  // 1 / sqrt(reach^2 + slope^2 height^2)
  V q, y0, y1;

  HWY_INLINE SegmentView(const SegmentElement& element, V x, V y, V z)
  {
    const V rx = hn::Sub(x, set(element.start[0]));
    const V ry = hn::Sub(y, set(element.start[1]));
    const V rz = hn::Sub(z, set(element.start[2]));
    const V one = set(kNumbers.one);
    along = dot(element.direction, rx, ry, rz);
    px = hn::NegMulAdd(along, set(element.direction[0]), rx);
    py = hn::NegMulAdd(along, set(element.direction[1]), ry);
    pz = hn::NegMulAdd(along, set(element.direction[2]), rz);
    squaredHeight = squaredNorm(px, py, pz);
    const V ahead = hn::Sub(set(element.length), along);
    if (element.slope == 0.0)
    {
      reach = set(element.startReach);
      inverseScale = set(element.inverseStart);
      y0 = hn::Neg(hn::Mul(along, inverseScale));
      y1 = hn::Mul(ahead, inverseScale);
    }
    else
    {
      const V slope = set(element.slope);
      const V lift = hn::Mul(slope, squaredHeight);
      reach = hn::MulAdd(slope, along, set(element.startReach));
      const V scale = hn::MulAdd(reach, reach, hn::Mul(slope, lift));
      inverseScale = hn::Div(one, hn::Sqrt(hn::Max(scale, set(kSmallestSquare))));
      y0 = hn::Mul(
        hn::Neg(hn::MulAdd(reach, along, lift)), hn::Mul(inverseScale, set(element.inverseStart)));
      y1 = hn::Mul(hn::MulSub(reach, ahead, lift), hn::Mul(inverseScale, set(element.inverseEnd)));
    }
    q = hn::NegMulAdd(squaredHeight, hn::Mul(inverseScale, inverseScale), one);
  }
};

// What the field of a segment, as a function of q and both ends, turns into as a function of p.
struct SegmentSlopes
{
  V q, y0, y1; // derivatives of the field by these
};

HWY_INLINE void addSegmentGradient(const SegmentElement& element, const SegmentView& view,
  const SegmentSlopes& by, V& gx, V& gy, V& gz)
{
  const V s = view.inverseScale;
  V alongSlope;
  V heightSlope; // by the squared height
  if (element.slope == 0.0)
  {
    alongSlope = hn::Neg(hn::Mul(hn::Add(by.y0, by.y1), s));
    heightSlope = hn::Neg(hn::Mul(by.q, hn::Mul(s, s)));
  }
  else
  {
    const V m = set(element.slope);
    const V s2 = hn::Mul(s, s);
    const V turn = hn::Mul(hn::Mul(m, view.reach), s2); // of log scale along the line
    const V start = hn::Mul(by.y0, hn::Mul(s, set(element.inverseStart)));
    const V end = hn::Mul(by.y1, hn::Mul(s, set(element.inverseEnd)));
    const V both = hn::MulAdd(by.y0, view.y0, hn::Mul(by.y1, view.y1));
    // d(numerator)/d(along) = slope (s - along) - reach, at both ends.
    const V here = hn::MulAdd(m, view.along, view.reach);
    alongSlope = hn::Mul(start, hn::Neg(here));
    alongSlope = hn::MulAdd(end, hn::Sub(set(element.slope * element.length), here), alongSlope);
    alongSlope = hn::NegMulAdd(both, turn, alongSlope);
    alongSlope = hn::MulAdd(
      by.q, hn::Mul(hn::Mul(set(2.0), turn), hn::Mul(view.squaredHeight, s2)), alongSlope);
    heightSlope = hn::NegMulAdd(m, hn::Add(start, end), hn::Zero(D()));
    heightSlope = hn::NegMulAdd(both, hn::Mul(hn::Mul(m, m), hn::Mul(set(0.5), s2)), heightSlope);
    const V ratio = hn::Mul(view.reach, s2);
    heightSlope = hn::NegMulAdd(by.q, hn::Mul(ratio, ratio), heightSlope);
  }
  const V outward = hn::Add(heightSlope, heightSlope);
  gx = hn::MulAdd(alongSlope, set(element.direction[0]), hn::MulAdd(outward, view.px, gx));
  gy = hn::MulAdd(alongSlope, set(element.direction[1]), hn::MulAdd(outward, view.py, gy));
  gz = hn::MulAdd(alongSlope, set(element.direction[2]), hn::MulAdd(outward, view.pz, gz));
}

// A point seen from the plane of a triangle: 1 - d^2/R^2 = q - |y|^2, y in the triangle (u, v).
struct TriangleView
{
  V height;
  V reach;        // R at the projection
  V inverseScale; // 1 / sqrt(reach^2 + slope^2 height^2)
  V q;
  V a, b; // coordinates of the projection
  std::array<V, 3> u, v;

  HWY_INLINE TriangleView(const TriangleElement& element, V x, V y, V z)
  {
    const V rx = hn::Sub(x, set(element.origin[0]));
    const V ry = hn::Sub(y, set(element.origin[1]));
    const V rz = hn::Sub(z, set(element.origin[2]));
    a = dot(element.axes.col(0), rx, ry, rz);
    b = dot(element.axes.col(1), rx, ry, rz);
    height = dot(element.axes.col(2), rx, ry, rz);
    if (element.slope == 0.0)
    {
      reach = set(element.originReach);
      inverseScale = set(element.inverse[0]);
    }
    else
    {
      const V lift = hn::Mul(set(element.slope), height);
      reach = hn::MulAdd(set(element.slope), a, set(element.originReach));
      const V scale = hn::MulAdd(reach, reach, hn::Mul(lift, lift));
      inverseScale = hn::Div(set(1.0), hn::Sqrt(hn::Max(scale, set(kSmallestSquare))));
    }
    const V ratio = hn::Mul(height, inverseScale);
    q = hn::NegMulAdd(ratio, ratio, set(1.0));
  }

  HWY_INLINE void placeCorners(const TriangleElement& element)
  {
    const V lift = hn::Mul(set(element.slope), hn::Mul(height, height));
    for (std::size_t k = 0; k < 3; ++k)
    {
      const V inverse = set(element.inverse[k]);
      const V ahead = hn::Sub(set(element.x[k]), a);
      v[k] = hn::Mul(hn::Sub(set(element.y[k]), b), inverse);
      u[k] = element.slope == 0.0
        ? hn::Mul(ahead, inverse)
        : hn::Mul(hn::MulSub(reach, ahead, lift), hn::Mul(inverse, inverseScale));
    }
  }
};

// Derivatives of a triangle's field by q and by its corners in the plane of (u, v).
struct TriangleSlopes
{
  V q;
  std::array<V, 3> u, v;
};

// The edge from corner k to the next, in the plane of (u, v).
struct TriangleEdge
{
  V ex, ey;     // unit, along the edge
  V distance;   // of the origin, positive inside
  V start, end; // coordinates of the ends along the edge, from the foot of the origin
  V inverseLength;

  HWY_INLINE TriangleEdge(const TriangleElement& element, const TriangleView& view, std::size_t k)
  {
    const std::size_t next = (k + 1) % 3;
    if (element.slope == 0.0)
    {
      // The triangle itself, in units of R.
      inverseLength = set(element.originReach * element.inverseLength[k]);
      ex = set(element.edgeX[k]);
      ey = set(element.edgeY[k]);
    }
    else
    {
      const V dx = hn::Sub(view.u[next], view.u[k]);
      const V dy = hn::Sub(view.v[next], view.v[k]);
      const V squared = hn::Max(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), set(kSmallestSquare));
      inverseLength = hn::Div(set(1.0), hn::Sqrt(squared));
      ex = hn::Mul(dx, inverseLength);
      ey = hn::Mul(dy, inverseLength);
    }
    distance = hn::MulSub(ey, view.u[k], hn::Mul(ex, view.v[k]));
    start = hn::MulAdd(ex, view.u[k], hn::Mul(ey, view.v[k]));
    end = hn::MulAdd(ex, view.u[next], hn::Mul(ey, view.v[next]));
  }

  // A corner that moves takes the points of its edges along, in proportion: from the integrals of
  // the kernel, and of l times the kernel, along the edge.
  HWY_INLINE void addSlopes(std::size_t k, V zeroth, V first, TriangleSlopes& slopes) const
  {
    const std::size_t next = (k + 1) % 3;
    const V atEnd = hn::Mul(hn::NegMulAdd(start, zeroth, first), inverseLength);
    const V atStart = hn::Sub(zeroth, atEnd);
    slopes.u[k] = hn::MulAdd(ey, atStart, slopes.u[k]);
    slopes.v[k] = hn::NegMulAdd(ex, atStart, slopes.v[k]);
    slopes.u[next] = hn::MulAdd(ey, atEnd, slopes.u[next]);
    slopes.v[next] = hn::NegMulAdd(ex, atEnd, slopes.v[next]);
  }
};

HWY_INLINE void addTriangleGradient(const TriangleElement& element, const TriangleView& view,
  const TriangleSlopes& by, V& gx, V& gy, V& gz)
{
  const V s = view.inverseScale;
  const V zero = hn::Zero(D());
  V alongSlope = zero;
  V acrossSlope = zero;
  V heightSlope = zero;
  const V m = set(element.slope);
  const V s2 = hn::Mul(s, s);
  V both = zero;
  V ends = zero;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const V inverse = set(element.inverse[k]);
    acrossSlope = hn::NegMulAdd(by.v[k], inverse, acrossSlope);
    if (element.slope == 0.0)
    {
      alongSlope = hn::NegMulAdd(by.u[k], inverse, alongSlope);
      continue;
    }
    const V end = hn::Mul(by.u[k], hn::Mul(s, inverse));
    const V numerator = hn::MulSub(m, hn::Sub(set(element.x[k]), view.a), view.reach);
    alongSlope = hn::MulAdd(end, numerator, alongSlope);
    ends = hn::Add(ends, end);
    both = hn::MulAdd(by.u[k], view.u[k], both);
  }
  if (element.slope == 0.0)
  {
    heightSlope = hn::Mul(hn::Mul(set(-2.0), by.q), hn::Mul(view.height, s2));
  }
  else
  {
    const V turn = hn::Mul(hn::Mul(m, view.reach), s2);
    const V lift = hn::Mul(m, view.height);
    const V ratio = hn::Mul(view.height, s);
    alongSlope = hn::NegMulAdd(both, turn, alongSlope);
    alongSlope =
      hn::MulAdd(by.q, hn::Mul(hn::Mul(set(2.0), turn), hn::Mul(ratio, ratio)), alongSlope);
    heightSlope = hn::Mul(hn::Mul(set(-2.0), lift), ends);
    heightSlope = hn::NegMulAdd(both, hn::Mul(hn::Mul(m, lift), s2), heightSlope);
    const V steep = hn::Mul(view.reach, s2);
    heightSlope = hn::NegMulAdd(
      by.q, hn::Mul(hn::Mul(set(2.0), view.height), hn::Mul(steep, steep)), heightSlope);
  }
  const Mat3& axes = element.axes;
  gx = hn::Add(gx, dot(axes.row(0).transpose(), alongSlope, acrossSlope, heightSlope));
  gy = hn::Add(gy, dot(axes.row(1).transpose(), alongSlope, acrossSlope, heightSlope));
  gz = hn::Add(gz, dot(axes.row(2).transpose(), alongSlope, acrossSlope, heightSlope));
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#endif // per-target include guard
