// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/convolution/BlendingControl.h"
#include "core/convolution/ConvolutionField.h"
#include "core/convolution/LimbKernels.h"
#include "core/convolution/PieceCutter.h"

#include <memory>

namespace hybridtree
{

/// A sparse matrix: per piece what others count, ascending.
struct PieceTable
{
  std::vector<std::uint32_t> begin; ///< of each row, and behind the last
  std::vector<PieceWeight> weights;

  operator PieceRows() const { return { begin.data(), weights.data() }; }
};

/// A skeleton in pieces (PieceCutter.h), and what these are to each other by their distance along
/// it: together with the kernels they tell on which limb a point is (LimbMeans.h).
///
/// With a kernel that ends, tables have only pieces whose fields may meet.
class BlendPieces
{
public:
  /// Of one piece.
  struct Piece
  {
    std::int32_t group;
    bool isTriangle;
    std::uint32_t begin, end; ///< elements
    ElementBall ball;         ///< around their reaches
  };

  /// \pre BlendingKind::Neighbours. \throws TooLarge
  BlendPieces(const GroupedElements& elements, const BlendingControl& control,
    const ConvolutionKernel& kernel);

  std::size_t size() const { return pieces_.size(); }
  const Piece& operator[](std::size_t k) const { return pieces_[k]; }
  /// All elements of the pieces. Null where they are those of the skeleton.
  const ConvolutionField* elements() const { return elements_.get(); }
  ///@{
  /// The piece of an element of elements(), or of the skeleton.
  std::uint32_t ofSegment(std::size_t k) const { return segmentPieces_[k]; }
  std::uint32_t ofTriangle(std::size_t k) const { return trianglePieces_[k]; }
  ///@}

  ///@{
  /// Pieces of segments come first. Of a piece of segments, or of triangles among those of
  /// triangles: its first element; and the first behind all.
  std::size_t segmentPieceCount() const { return segmentsBegin_.size() - 1; }
  const std::uint32_t* segmentsBegin() const { return segmentsBegin_.data(); }
  const std::uint32_t* trianglesBegin() const { return trianglesBegin_.data(); }
  ///@}

  bool isLocal() const { return isLocal_; } ///< the kernel ends
  /// Beta: 1 up to one R, 0 from 2 R on.
  const PieceTable& sights() const { return sights_; }
  /// 1 - alpha when isLocal(), otherwise alpha.
  const PieceTable& shares() const { return shares_; }

  ///@{
  /// Per group of elements, ascending: those of which any piece does not blend fully with any of
  /// its own (when isLocal()), or does at all and is seen by any (otherwise; itself, too).
  const std::vector<std::int32_t>& apart(std::size_t group) const { return shareGroups_[group]; }
  const std::vector<std::int32_t>& sharing(std::size_t group) const { return shareGroups_[group]; }
  const std::vector<std::int32_t>& seen(std::size_t group) const { return sightGroups_[group]; }
  ///@}
  std::size_t groupCount() const { return groupBegin_.size(); }
  /// Of a group: its first piece, and the first behind. Groups have segments or triangles.
  std::uint32_t begin(std::size_t group) const { return groupBegin_[group]; }
  std::uint32_t end(std::size_t group) const { return groupEnd_[group]; }

  ///@{
  /// Where the kernel does not end: all of elements(), and bounds of the fields of pieces.
  const ElementSelection& all() const { return all_; }
  FarBounds bounds() const;
  double meanReach() const { return meanReach_; } ///< R
  ///@}
  /// Adds pieces, and what they are to each other. \param isMet per piece: whether to add it.
  /// \param whole the skeleton's elements.
  void describe(
    const std::vector<char>& isMet, const ConvolutionField& whole, Contents& contents) const;

  /// Of a piece, on average: how many others there are in the tables.
  double meanNear() const;

private:
  class Relations;

  void addPieces(const CutPieces& cut, std::size_t groups);
  void findBounds(const CutPieces& cut, const ConvolutionKernel& kernel);
  std::size_t boundsSize() const;
  void findGroups(const PieceTable& table, std::vector<std::vector<std::int32_t>>& lists) const;

  bool isLocal_;
  std::vector<Piece> pieces_;
  std::unique_ptr<const ConvolutionField> elements_;
  std::vector<std::uint32_t> segmentPieces_;
  std::vector<std::uint32_t> trianglePieces_;
  PieceTable sights_;
  PieceTable shares_;
  std::vector<std::vector<std::int32_t>> shareGroups_;
  std::vector<std::vector<std::int32_t>> sightGroups_;
  std::vector<std::uint32_t> segmentsBegin_;
  std::vector<std::uint32_t> trianglesBegin_;
  ElementSelection all_;
  double meanReach_ = 0.0;
  std::vector<double> bounds_; // rows as of FarBounds
  std::vector<std::uint32_t> groupBegin_;
  std::vector<std::uint32_t> groupEnd_;
};

} // namespace hybridtree
