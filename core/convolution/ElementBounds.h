// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionElement.h"
#include "core/convolution/ConvolutionKernel.h"

namespace hybridtree
{

///@{
/// Largest R, and distance of a point from the element.
double largestReach(const SegmentElement& element);
double largestReach(const TriangleElement& element);
double distanceTo(const SegmentElement& element, const Vec3& p);
double distanceTo(const TriangleElement& element, const Vec3& p);
Box3 boundsOf(const SegmentElement& element);
Box3 boundsOf(const TriangleElement& element);
///@}

/// How large the field of elements and its derivatives may be: sums of upper bounds.
struct FieldBounds
{
  double value = 0.0;     ///< of the field, which is nowhere negative
  double slope = 0.0;     ///< of the length of its gradient
  double curvature = 0.0; ///< of the norm of its second derivative; infinite where there is none
};

///@{
/// Adds the bounds of one element at all points at least `distance` away from it.
void addBounds(const SegmentElement& element, const ConvolutionKernel& kernel, double distance,
  FieldBounds& bounds);
void addBounds(const TriangleElement& element, const ConvolutionKernel& kernel, double distance,
  FieldBounds& bounds);
///@}

/// The same of the value of some elements with the Cauchy kernel, coarser: all from their bounding
/// box at once (LimbKernels.h).
class CauchyBound
{
public:
  ///@{
  void add(const SegmentElement& element, const ConvolutionKernel& kernel);
  void add(const TriangleElement& element, const ConvolutionKernel& kernel);
  ///@}

  double largestReach() const { return reach_; }
  const Box3& box() const { return box_; }
  double measure() const { return measure_; } ///< sum of measures times amplitudes
  double slope() const { return slope_; }     ///< the largest

private:
  Box3 box_;
  double reach_ = 0.0;
  double measure_ = 0.0;
  double slope_ = 0.0;
};

} // namespace hybridtree
