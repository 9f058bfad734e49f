// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionElement.h"
#include "core/convolution/ConvolutionKernel.h"

#include <cstddef>
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

/// Batched sums of closed-form integrals over elements. A value depends on its point alone, not on
/// its place in the batch; it is exactly 0 beyond the reach of a compact kernel. Gradients are
/// exact.
struct ConvolutionKernels
{
  void (*addSegments)(
    ElementSpan<SegmentElement>, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addSegmentsWithGradient)(ElementSpan<SegmentElement>, const ConvolutionKernel&, PointBatch,
    double* sum, VectorBatch gradientSum);
  void (*addTriangles)(
    ElementSpan<TriangleElement>, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addTrianglesWithGradient)(ElementSpan<TriangleElement>, const ConvolutionKernel&,
    PointBatch, double* sum, VectorBatch gradientSum);
  /// \pre the lists of the next two are not empty.
  void (*addShared)(
    const std::vector<SharedElements>&, const ConvolutionKernel&, PointBatch, double* sum);
  void (*addSharedWithGradient)(const std::vector<SharedElements>&, const ConvolutionKernel&,
    PointBatch, double* sum, VectorBatch gradientSum);
};

/// Those of the kernel for the widest vector instructions of this processor.
const ConvolutionKernels& convolutionKernels(KernelKind kind);
const ConvolutionKernels& compactConvolutionKernels();
const ConvolutionKernels& cauchyConvolutionKernels();

} // namespace hybridtree
