// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"
#include "core/convolution/ConvolutionKernels.h"
#include "core/convolution/PieceWeights.h"

#include <cstdint>

namespace hybridtree
{

/// Of numbers per piece that are found on the way.
inline constexpr std::size_t kLimbRows = 5;

/// Fields of pieces at kRowStep points, and what the pieces are to each other (LimbMeans.h).
struct LimbBlock
{
  const std::uint32_t* pieces; ///< those that may have fields here
  std::size_t count;
  const std::uint32_t* centers; ///< those among them that may have weights
  std::size_t centerCount;
  const double* fields; ///< of piece k from fields + k * stride: values, and gradients behind
  std::size_t stride;
  PieceRows sights;       ///< beta
  PieceRows shares;       ///< alpha, or 1 - alpha
  bool areLosses;         ///< the latter
  double* work;           ///< kLimbRows * kRowStep per piece
  std::size_t rowSize;    ///< kRowStep per piece
  std::uint32_t* reached; ///< 2 * count
};

/// Upper bounds of fields with the Cauchy kernel, from balls around what they are of: rows of
/// numbers, one per piece, as many as a multiple of kRowStep.
struct FarBounds
{
  std::size_t size; ///< of a row
  const double* x;
  const double* y;
  const double* z;
  const double* radius;
  const double* inverseReach; ///< the smallest
  const double* measure;      ///< times amplitude
  const double* slope;        ///< the largest of R
};

/// Below this part of the largest what a piece sees is not counted: its 20th power is less than
/// rounding.
inline constexpr double kLeastSight = 0.15;

/// Arithmetic on kRowStep points at once, for the widest vector instructions of this processor.
/// What comes out at a point does not depend on the others.
struct LimbKernels
{
  /// S at kRowStep points; and its gradient, unless null. Overwrites both.
  void (*findMeans)(const LimbBlock& block, double* value, const VectorBatch* gradient);
  /// Which of up to 64 points, as many as a multiple of kRowStep, are in a ball: bits.
  std::uint64_t (*findInside)(const ElementBall& ball, PointBatch points);
  /// The most that each field is anywhere in a box.
  void (*findMost)(const FarBounds& bounds, const Box3& box, double* most);
};

const LimbKernels& limbKernels();

} // namespace hybridtree
