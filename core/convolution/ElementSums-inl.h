// SPDX-License-Identifier: BSD-3-Clause
// The loops over elements, for any kernel. Included once per instruction set; so no #pragma once.
#if defined(HYBRIDTREE_ELEMENT_SUMS) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_ELEMENT_SUMS
#undef HYBRIDTREE_ELEMENT_SUMS
#else
#define HYBRIDTREE_ELEMENT_SUMS
#endif

#include "core/convolution/ConvolutionKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// Loop bodies for forEachVector(). Integral has
// - void add(const Element&, V x, V y, V z, V& value) const,
// - void addWithGradient(const Element&, V x, V y, V z, V& value, V& gx, V& gy, V& gz) const,
// and the amplitude, by which sums are multiplied in the end.
template <class Element, class Integral>
struct AddElementsBody
{
  ElementSpan<Element> span;
  Integral integral;
  double amplitude;

  HWY_INLINE void operator()(
    const double* x, const double* y, const double* z, const std::array<double*, 1>& out) const
  {
    const D d;
    V value = hn::Zero(d);
    for (std::size_t k = 0; k < span.count; ++k)
    {
      integral.add(*span.elements[k], hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z), value);
    }
    hn::StoreU(hn::MulAdd(set(amplitude), value, hn::LoadU(d, out[0])), d, out[0]);
  }
};

template <class Element, class Integral>
struct AddElementsWithGradientBody
{
  ElementSpan<Element> span;
  Integral integral;
  double amplitude;

  HWY_INLINE void operator()(
    const double* x, const double* y, const double* z, const std::array<double*, 4>& out) const
  {
    const D d;
    V sum[4] = { hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d) };
    for (std::size_t k = 0; k < span.count; ++k)
    {
      integral.addWithGradient(*span.elements[k], hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z),
        sum[0], sum[1], sum[2], sum[3]);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      hn::StoreU(hn::MulAdd(set(amplitude), sum[k], hn::LoadU(d, out[k])), d, out[k]);
    }
  }
};

inline double amplitudeOf(const ConvolutionKernel& kernel, const SegmentElement*)
{
  return segmentAmplitude(kernel);
}

inline double amplitudeOf(const ConvolutionKernel& kernel, const TriangleElement*)
{
  return triangleAmplitude(kernel);
}

// A value and, as Rows is 1 or 4, its gradient.
template <std::size_t Rows>
struct Sample
{
  V rows[Rows];

  HWY_INLINE Sample()
  {
    for (V& row : rows)
    {
      row = hn::Zero(D());
    }
  }
};

// Two of the functions of a ConvolutionKernels, and a third.
template <class Element, class Integral>
struct ElementSums
{
  static void rows(const PieceElements<Element>& pieces, const ConvolutionKernel& kernel,
    PointBatch points, const ElementRows& to)
  {
    if (to.haveGradients)
    {
      fillRows<4>(pieces, kernel, points, to);
    }
    else
    {
      fillRows<1>(pieces, kernel, points, to);
    }
  }
  static void add(
    ElementSpan<Element> span, const ConvolutionKernel& kernel, PointBatch points, double* sum)
  {
    const double amplitude = amplitudeOf(kernel, static_cast<const Element*>(nullptr));
    forEachVector<1>(
      points, { sum }, AddElementsBody<Element, Integral>{ span, Integral(kernel), amplitude });
  }
  static void addWithGradient(ElementSpan<Element> span, const ConvolutionKernel& kernel,
    PointBatch points, double* sum, VectorBatch gradient)
  {
    const double amplitude = amplitudeOf(kernel, static_cast<const Element*>(nullptr));
    forEachVector<4>(points, { sum, gradient.x, gradient.y, gradient.z },
      AddElementsWithGradientBody<Element, Integral>{ span, Integral(kernel), amplitude });
  }

private:
  template <std::size_t Rows>
  static void fillRows(const PieceElements<Element>& pieces, const ConvolutionKernel& kernel,
    PointBatch points, const ElementRows& to)
  {
    const D d;
    const Integral integral(kernel);
    const V amplitude = set(amplitudeOf(kernel, static_cast<const Element*>(nullptr)));
    for (std::size_t at = 0; at < points.size; at += hn::Lanes(d))
    {
      const V x = hn::LoadU(d, points.x + at);
      const V y = hn::LoadU(d, points.y + at);
      const V z = hn::LoadU(d, points.z + at);
      double* row = to.first + at;
      for (std::size_t piece = 0; piece < pieces.count; ++piece)
      {
        Sample<Rows> sample;
        for (std::uint32_t k = pieces.begin[piece]; k < pieces.begin[piece + 1]; ++k)
        {
          if constexpr (Rows == 1)
          {
            integral.add(*pieces.elements[k], x, y, z, sample.rows[0]);
          }
          else
          {
            integral.addWithGradient(*pieces.elements[k], x, y, z, sample.rows[0], sample.rows[1],
              sample.rows[2], sample.rows[3]);
          }
        }
        for (std::size_t r = 0; r < Rows; ++r, row += to.stride)
        {
          hn::StoreU(hn::Mul(amplitude, sample.rows[r]), d, row);
        }
      }
    }
  }
};

template <class Segments, class Triangles, std::size_t Rows>
struct AddSharedBody
{
  const SharedElements* begin;
  const SharedElements* end;
  bool haveTriangles;
  Segments segments;
  Triangles triangles;
  double segmentAmplitude;
  double triangleAmplitude;

  HWY_INLINE void operator()(const double* px, const double* py, const double* pz,
    const std::array<double*, Rows>& out) const
  {
    const D d;
    const V x = hn::LoadU(d, px);
    const V y = hn::LoadU(d, py);
    const V z = hn::LoadU(d, pz);
    addParts<SegmentElement>(segments, segmentAmplitude, x, y, z, out);
    if (haveTriangles)
    {
      addParts<TriangleElement>(triangles, triangleAmplitude, x, y, z, out);
    }
  }

private:
  static const ElementSpan<SegmentElement>& listOf(
    const SharedElements& part, const SegmentElement*)
  {
    return part.segments;
  }
  static const ElementSpan<TriangleElement>& listOf(
    const SharedElements& part, const TriangleElement*)
  {
    return part.triangles;
  }

  template <class Element, class Integral>
  HWY_INLINE void addParts(const Integral& integral, double amplitude, V x, V y, V z,
    const std::array<double*, Rows>& out) const
  {
    const D d;
    Sample<Rows> total;
    for (const SharedElements* part = begin; part != end; ++part)
    {
      const V u = parameter(*part, x, y, z);
      const ElementSpan<Element>& list = listOf(*part, static_cast<const Element*>(nullptr));
      if (hn::AllTrue(d, hn::Ge(u, set(1.0))))
      {
        continue; // counts nothing
      }
      Sample<Rows> own;
      for (std::size_t k = 0; k < list.count; ++k)
      {
        if constexpr (Rows == 1)
        {
          integral.add(*list.elements[k], x, y, z, own.rows[0]);
        }
        else
        {
          integral.addWithGradient(
            *list.elements[k], x, y, z, own.rows[0], own.rows[1], own.rows[2], own.rows[3]);
        }
      }
      if (part == begin)
      {
        total = own;
      }
      else
      {
        addShare(*part, u, own, total);
      }
    }
    for (std::size_t row = 0; row < Rows; ++row)
    {
      hn::StoreU(hn::MulAdd(set(amplitude), total.rows[row], hn::LoadU(d, out[row])), d, out[row]);
    }
  }

  // 0 to 1.
  static HWY_INLINE V parameter(const SharedElements& part, V x, V y, V z)
  {
    const V u = hn::Add(dot(part.slope, x, y, z), set(part.offset));
    return hn::Min(hn::Max(u, hn::Zero(D())), set(1.0));
  }

  static HWY_INLINE void addShare(
    const SharedElements& part, V u, const Sample<Rows>& own, Sample<Rows>& total)
  {
    const V one = set(1.0);
    const V square = hn::Mul(u, u);
    const V inner = hn::MulAdd(u, hn::MulAdd(u, set(6.0), set(-15.0)), set(10.0));
    const V share = hn::NegMulAdd(hn::Mul(square, u), inner, one);
    for (std::size_t row = 0; row < Rows; ++row)
    {
      total.rows[row] = hn::MulAdd(share, own.rows[row], total.rows[row]);
    }
    if constexpr (Rows == 4)
    {
      const V rest = hn::Sub(one, u);
      const V fall = hn::Mul(hn::Mul(set(-30.0), square), hn::Mul(rest, rest));
      const V step = hn::Mul(fall, own.rows[0]);
      for (int axis = 0; axis < 3; ++axis)
      {
        V& row = total.rows[std::size_t(axis) + 1];
        row = hn::MulAdd(step, set(part.slope[axis]), row);
      }
    }
  }
};

// The other two.
template <class Segments, class Triangles>
struct SharedSums
{
  static void add(const std::vector<SharedElements>& parts, const ConvolutionKernel& kernel,
    PointBatch points, double* sum)
  {
    forEachVector<1>(points, { sum }, body<1>(parts, kernel));
  }
  static void addWithGradient(const std::vector<SharedElements>& parts,
    const ConvolutionKernel& kernel, PointBatch points, double* sum, VectorBatch gradient)
  {
    forEachVector<4>(points, { sum, gradient.x, gradient.y, gradient.z }, body<4>(parts, kernel));
  }

private:
  template <std::size_t Rows>
  static AddSharedBody<Segments, Triangles, Rows> body(
    const std::vector<SharedElements>& parts, const ConvolutionKernel& kernel)
  {
    const bool haveTriangles = std::any_of(parts.begin(), parts.end(),
      [](const SharedElements& part) { return part.triangles.count > 0; });
    return { parts.data(), parts.data() + parts.size(), haveTriangles, Segments(kernel),
      Triangles(kernel), segmentAmplitude(kernel), triangleAmplitude(kernel) };
  }
};

template <class Segments, class Triangles, class Shared>
const ConvolutionKernels* kernelsOf()
{
  static const ConvolutionKernels kernels = { &Segments::add, &Segments::addWithGradient,
    &Segments::rows, &Triangles::add, &Triangles::addWithGradient, &Triangles::rows, &Shared::add,
    &Shared::addWithGradient };
  return &kernels;
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#endif // per-target include guard
