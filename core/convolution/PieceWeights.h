// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace hybridtree
{

/// What another piece counts for one.
struct PieceWeight
{
  std::uint32_t piece;
  double weight;
};

/// Row by row of a sparse matrix: those of piece k from begin[k] to begin[k + 1].
struct PieceRows
{
  const std::uint32_t* begin;
  const PieceWeight* weights;
};

} // namespace hybridtree
