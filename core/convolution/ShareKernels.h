// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace hybridtree
{

/// A row of numbers that goes into another, multiplied.
struct ScaledRow
{
  double scale;
  double* row;
};

/// A column of a matrix, and the row that its product goes into.
struct ProductColumn
{
  std::size_t column;
  double* row;
};

/// Rows that a share is found from, and those that it makes (BlendedField.h), of one group j.
struct ShareRows
{
  const double* sum;  ///< F, of all pieces c: the sum of f_c
  const double* near; ///< the sum of f_c (farthest - d(c, j))
  const double* own;  ///< f_j
  double* share;      ///< alpha(D_j), D_j = farthest - near / F
  double* step;       ///< s_j = f_j alpha'(D_j) / F
  double* total;      ///< grows by alpha f_j
  double* shift;      ///< grows by s_j near / F
};

/// Arithmetic on rows, of as many numbers as a multiple of kRowStep (ConvolutionKernels.h), for the
/// widest vector instructions of this processor.
struct ShareKernels
{
  /// Each of `to` grows by scale * from.
  void (*addScaled)(const double* from, std::size_t size, const ScaledRow* to, std::size_t count);
  /// The row of each of `to` grows by scale times the product of `count` rows, `stride` apart, and
  /// its column of the matrix `weights` of count x columns.
  void (*addProducts)(const double* from, std::size_t stride, std::size_t count,
    const double* weights, std::size_t columns, double scale, std::size_t size,
    const ProductColumn* to, std::size_t wanted);
  /// alpha falls from 1 at `begin` to 0 one later. \return whether any step is not 0.
  bool (*findShares)(double begin, double farthest, std::size_t size, const ShareRows& rows);
  /// weight = share + shift - sum of scale * row; each of `to` grows by weight * gradient, both
  /// three rows, `stride` apart.
  void (*addGradient)(const double* share, const double* shift, const ScaledRow* steps,
    std::size_t count, std::size_t size, const double* gradient, std::size_t stride, double* to);
};

const ShareKernels& shareKernels();

} // namespace hybridtree
