// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionElement.h"
#include "core/convolution/ConvolutionKernel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Elements by pointers: those that reach a place, wherever they are stored.
template <class Element>
struct ElementSpan
{
  const Element* const* elements = nullptr;
  std::size_t count = 0;
};

/// Elements that count share(slope . p + offset) at p, where share falls from 1 at 0 to 0 at 1 as
/// BlendShare does; those of the first of a list count whole.
struct SharedElements
{
  ElementSpan<SegmentElement> segments;
  ElementSpan<TriangleElement> triangles;
  Vec3 slope;
  double offset;
};

/// Elements in pieces: those of piece k from begin[k] to begin[k + 1].
template <class Element>
struct PieceElements
{
  const Element* const* elements;
  const std::uint32_t* begin;
  std::size_t count; ///< of pieces
};

/// Where the fields of single pieces go: a row of values per piece, and behind it the three of the
/// gradient where there are any.
struct ElementRows
{
  double* first;
  std::size_t stride; ///< from row to row, at least as many as there are points
  bool haveGradients;
};

/// Points of a batch for ElementRows are a multiple of this.
inline constexpr std::size_t kRowStep = 8;

/// Batched closed-form integrals over elements: their sums, or those of each piece by itself. A
/// value depends on its point alone, not on its place in the batch; it is exactly 0 beyond the
/// reach of a compact kernel. Gradients are exact.
struct ConvolutionKernels
{
  void (*addSegments)(
    ElementSpan<SegmentElement>, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addSegmentsWithGradient)(ElementSpan<SegmentElement>, const ConvolutionKernel&, PointBatch,
    double* sum, VectorBatch gradientSum);
  void (*segmentRows)(
    const PieceElements<SegmentElement>&, const ConvolutionKernel&, PointBatch, const ElementRows&);
  void (*addTriangles)(
    ElementSpan<TriangleElement>, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addTrianglesWithGradient)(ElementSpan<TriangleElement>, const ConvolutionKernel&,
    PointBatch, double* sum, VectorBatch gradientSum);
  void (*triangleRows)(const PieceElements<TriangleElement>&, const ConvolutionKernel&, PointBatch,
    const ElementRows&);
  /// \pre the lists of the next two are not empty.
  void (*addShared)(
    const std::vector<SharedElements>&, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addSharedWithGradient)(const std::vector<SharedElements>&, const ConvolutionKernel&,
    PointBatch, double* sum, VectorBatch gradientSum);
};

/// Numbers in the inner loops. Compilers that know them set up a vector for each ahead of every
/// loop, which takes as long as half of an element; so they are told only where to read them. (No
/// default values: with these they would read them again and again.)
struct KernelNumbers
{
  /// atan(t) / t on [0, 1] as a polynomial in t^2: Chebyshev's interpolation, error 3e-17.
  double evenPowers[10], oddPowers[10];
  double eighth, quarter, half, one, three, four, five, eight, halfPi, farthest;
};
extern const KernelNumbers kNumbers;

/// Those of the kernel for the widest vector instructions of this processor.
const ConvolutionKernels& convolutionKernels(KernelKind kind);
const ConvolutionKernels& compactConvolutionKernels();
const ConvolutionKernels& cauchyConvolutionKernels();

} // namespace hybridtree
