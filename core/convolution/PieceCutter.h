// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionElement.h"
#include "core/convolution/GroupedElements.h"
#include "core/convolution/PieceGraph.h"

namespace hybridtree
{

/// The elements of a skeleton in pieces of up to half of R along segments and 1.25 R between the
/// corners of triangles: long elements are cut, short ones of one group that follow each other
/// taken together.
struct CutPieces
{
  ///@{
  /// Elements, those of a piece in a row; in the order of the skeleton's, and the same where
  /// `areWhole`.
  std::vector<SegmentElement> segments;
  std::vector<TriangleElement> triangles;
  ///@}
  bool areWhole = true; ///< none was cut
  ///@{
  /// Of each element: its piece. Pieces of segments first, ascending.
  std::vector<std::uint32_t> segmentPieces;
  std::vector<std::uint32_t> trianglePieces;
  ///@}
  ///@{
  /// Of each piece.
  std::vector<PiecePlace> places;
  std::vector<std::int32_t> groups;
  ///@}
  ///@{
  /// Where pieces meet.
  std::vector<PieceContact> contacts;
  std::vector<PieceSide> sides;
  ///@}
};

CutPieces cutIntoPieces(const GroupedElements& elements);

} // namespace hybridtree
