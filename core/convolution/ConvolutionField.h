// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionKernels.h"
#include "core/convolution/ElementBounds.h"
#include "core/convolution/ElementTree.h"

#include <vector>

namespace hybridtree
{

/// Elements that are kept elsewhere.
struct ElementSpans
{
  ElementSpan<SegmentElement> segments;
  ElementSpan<TriangleElement> triangles;
};

/// Elements that may reach some place.
struct ElementSelection
{
  std::vector<const SegmentElement*> segments;
  std::vector<const TriangleElement*> triangles;

  bool empty() const { return segments.empty() && triangles.empty(); }
  operator ElementSpans() const
  {
    return { { segments.data(), segments.size() }, { triangles.data(), triangles.size() } };
  }
};

/// The sum of the fields of segments and triangles ([SUB] 3), in closed form, with a hierarchy over
/// the elements. Immutable: any number of threads may ask one object.
///
/// Queries take the elements to sum: those that select() found for a box that holds the points.
class ConvolutionField
{
public:
  ConvolutionField(const ConvolutionKernel& kernel, const std::vector<SegmentElement>& segments,
    const std::vector<TriangleElement>& triangles);

  const ConvolutionKernel& kernel() const { return kernel_; }

  /// Closure of where the field is not 0; for the Cauchy kernel, where it is not faded to 0.
  Box3 influenceBounds() const;

  /// The elements that reach the box, in the order given: all of them, and few others. Of the
  /// Cauchy kernel all or, where the sum is faded out, none. Overwrites `selection`.
  void select(const Box3& box, ElementSelection& selection) const;

  ///@{
  /// Places of selected elements in the arrays that the constructor was given.
  std::size_t index(const SegmentElement* segment) const;
  std::size_t index(const TriangleElement* triangle) const;
  ///@}

  ///@{
  /// The other way.
  const SegmentElement& segment(std::size_t k) const { return segments_[k]; }
  const TriangleElement& triangle(std::size_t k) const { return triangles_[k]; }
  ///@}

  void addField(const ElementSpans& elements, PointBatch points, double* sum) const;
  void addFieldAndGradient(
    const ElementSpans& elements, PointBatch points, double* sum, VectorBatch gradientSum) const;

  /// Adds bounds that hold in the whole box.
  void addBounds(const ElementSpans& elements, const Box3& box, FieldBounds& bounds) const;

  /// Bounds of the field in a box. \pre the selection is that of the box or of a larger one.
  Interval range(const ElementSpans& elements, const Box3& box) const;

private:
  // How far from the elements a field of a kernel without end is above kFadeEnd.
  double fadingDistance(const std::vector<SegmentElement>& segments,
    const std::vector<TriangleElement>& triangles) const;

  ConvolutionKernel kernel_;
  double fadingDistance_; ///< 0 for a compact kernel
  std::vector<SegmentElement> segments_;
  std::vector<TriangleElement> triangles_;
  ElementTree segmentTree_;
  ElementTree triangleTree_;
};

} // namespace hybridtree
