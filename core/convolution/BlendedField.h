// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendSelection.h"
#include "core/convolution/GroupedElements.h"
#include "core/convolution/PaperSums.h"

#include <memory>
#include <vector>

namespace hybridtree
{

/// The field of a skeleton under blending control: f = max over coarse elements i of G_i, G_i = sum
/// over j of alpha(D_ij) f_j, f_j being the sum over the children of j ([SUB] 5).
///
/// [SUB] lets alpha fall with the parameter u on the element nearest to the point, which makes the
/// extent of blends, and so the thickness, depend on the sizes of the coarse elements (its Figures
/// 15 and 16), and jumps where the nearest element changes. Here D_ij is a distance along the
/// skeleton in units of R: from the place of the point to element j, that place being spread over
/// the skeleton by the kernel itself, D_ij = sum of f_c d(c, j) / sum of f_c over the pieces c of
/// all elements near i. It is smooth, and as elements that are near each other average over the
/// same pieces, G_i and G_j agree where the point passes from one to the other. Where the skeleton
/// is straight or bends gently, all f_j > 0 have D_ij below the distance of full blending and f is
/// exactly the sum, however the skeleton is divided.
///
/// Immutable: any number of threads may ask one object.
class BlendedField
{
public:
  /// \pre validate() of both. \throws TooLarge
  BlendedField(const ConvolutionKernel& kernel, const BlendingControl& control,
    const GroupedElements& elements);

  const ConvolutionKernel& kernel() const { return whole_.kernel(); }
  /// Of all elements, without blending control.
  const ConvolutionField& sum() const { return whole_; }

  Box3 influenceBounds() const { return whole_.influenceBounds(); }

  /// Of a group, on average: how many others its sum takes in; 0 unless BlendingKind::Neighbours.
  double meanNeighbours() const;

  /// What reaches the box. Overwrites `selection`.
  void select(const Box3& box, BlendSelection& selection) const;

  ///@{
  /// \param selection of a box that holds the points; null when they may be anywhere.
  void addField(const BlendSelection* selection, PointBatch points, double* sum) const;
  void addFieldAndGradient(
    const BlendSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const;
  ///@}

  /// What G_i of one group alone would make of the field, for points that are known to belong to
  /// it (PaperSums.h, OwnBlend.h): nearly the field, at a part of the cost. Overwrites `value`, and
  /// `gradient` unless null. \pre not BlendingKind::All.
  /// \param selection of a box that holds the points; null when they may be anywhere.
  void ownSum(std::int32_t group, const BlendSelection* selection, PointBatch points, double* value,
    const VectorBatch* gradient) const;

  /// Bounds of the field in a box. \pre the selection is that of the box or of a larger one.
  Interval range(const BlendSelection& selection, const Box3& box) const;

  /// Adds all that the field in some boxes depends on, besides the elements that reach them. \pre
  /// BlendingKind::All, or the compact kernel.
  void describeBlending(const std::vector<Box3>& boxes, Contents& contents) const;

private:
  template <typename Body>
  void forCompactParts(PointBatch points, Body&& body) const;

  ElementGroups elementGroups() const;
  BlendGroups groups() const; ///< where neighbours blend
  void sumControlled(const BlendSelection& selection, PointBatch points, double* value,
    const VectorBatch* gradient) const;
  void ownBlend(std::int32_t group, const BlendSelection* selection, PointBatch points,
    double* value, const VectorBatch* gradient) const;
  Interval mixedRange(const BlendSelection& selection, const Box3& box) const;
  double mixedSlope(const BlendSelection& selection, const Box3& box) const;

  BlendingControl control_;
  ConvolutionField whole_;
  double partSize_; ///< how far apart points may be that are asked for together
  std::vector<std::int32_t> segmentGroups_;
  std::vector<std::int32_t> triangleGroups_;
  std::size_t groupCount_;

  // Where neighbours blend.
  BlendPieces places_;                             ///< without its elements: those are in pieces_
  std::unique_ptr<const ConvolutionField> pieces_; ///< otherwise null
  std::vector<FarGroup> farGroups_;

  std::unique_ptr<const PaperSums> paper_; ///< where they blend as in [SUB]; otherwise null
};

} // namespace hybridtree
