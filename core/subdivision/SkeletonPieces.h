// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonTopology.h"

#include <vector>

namespace hybridtree
{

/// Segments one after the other.
struct CurvePiece
{
  std::vector<std::int32_t> segments;
  std::vector<std::int32_t>
    points; ///< one more than segments; first and last are equal when closed
  bool closed = false;
};

/// Triangles that are joined by edges.
struct SurfacePiece
{
  std::vector<std::int32_t> triangles;
};

/// What a coarse skeleton is made of ([SUB] 4.1): the longest curves without a junction, and the
/// surfaces. Curves go on where SkeletonVertex says so, also past a surface that hangs on them.
///
/// Numbered curves first, then surfaces, each by its first segment or triangle.
struct SkeletonPieces
{
  std::vector<CurvePiece> curves;
  std::vector<SurfacePiece> surfaces;

  std::size_t size() const { return curves.size() + surfaces.size(); }
};

SkeletonPieces findPieces(const SkeletonGraph& graph, const SkeletonTopology& topology);

/// The piece that each element of the coarse skeleton is a part of.
struct PieceNumbers
{
  std::vector<std::int32_t> segments;
  std::vector<std::int32_t> triangles;
  std::int32_t count = 0;
};

PieceNumbers numberPieces(const SkeletonGraph& graph);

} // namespace hybridtree
