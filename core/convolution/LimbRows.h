// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Scratch.h"
#include "core/convolution/LimbKernels.h"

#include <algorithm>

namespace hybridtree
{

/// Numbers of pieces, kept elsewhere.
struct PieceList
{
  const std::uint32_t* first;
  std::size_t count;
};

/// Fields of pieces at few points, and the means of their limbs (LimbMeans.h).
class LimbRows
{
public:
  /// \param pieces how many numbers there are.
  LimbRows(const ConvolutionKernel& kernel, std::size_t pieces, bool haveGradients)
    : kernel_(kernel)
    , haveGradients_(haveGradients)
    , stride_(kRowStep * (haveGradients ? 4 : 1))
    , fields_(pieces * stride_)
    , work_(pieces * kLimbRows * kRowStep)
  {
  }

  /// Of pieces in a row, from `first` on, at kRowStep points.
  template <class Element>
  void integrate(const PieceElements<Element>& pieces, std::size_t first, PointBatch points)
  {
    const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
    if (pieces.count > 0)
    {
      rowsOf(
        kernels, pieces, { fields_.data() + first * stride_, kRowStep, haveGradients_ }, points);
    }
  }
  const double* field(std::size_t piece) const { return fields_.data() + piece * stride_; }

  /// At those kRowStep points. \param pieces, centers, sights, shares, areLosses as LimbBlock has
  /// them. Overwrites `value`, and `gradient` unless null.
  void findMeans(PieceList pieces, PieceList centers, PieceRows sights, PieceRows shares,
    bool areLosses, double* value, const VectorBatch* gradient)
  {
    static thread_local std::vector<std::uint32_t> reached; // no allocation once warm
    reached.resize(std::max(reached.size(), 2 * pieces.count));
    limbKernels().findMeans(
      { pieces.first, pieces.count, centers.first, centers.count, fields_.data(), stride_, sights,
        shares, areLosses, work_.data(), work_.size() / kLimbRows, reached.data() },
      value, gradient);
  }

private:
  void rowsOf(const ConvolutionKernels& kernels, const PieceElements<SegmentElement>& pieces,
    const ElementRows& rows, PointBatch points) const
  {
    kernels.segmentRows(pieces, kernel_, points, rows);
  }
  void rowsOf(const ConvolutionKernels& kernels, const PieceElements<TriangleElement>& pieces,
    const ElementRows& rows, PointBatch points) const
  {
    kernels.triangleRows(pieces, kernel_, points, rows);
  }

  const ConvolutionKernel& kernel_;
  bool haveGradients_;
  std::size_t stride_;
  ScratchArray fields_;
  ScratchArray work_;
};

} // namespace hybridtree
