// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendSelection.h"
#include "core/convolution/BlendingControl.h"
#include "core/convolution/GroupedElements.h"
#include "core/convolution/PaperSums.h"

#include <memory>
#include <vector>

namespace hybridtree
{

class BlendPieces;
class LimbMeans;

/// The field of a skeleton under blending control ([SUB] 5), so that limbs which only pass each
/// other are united, not blended.
///
/// [SUB] takes the largest of the sums around the coarse elements, in which others fade with the
/// parameter u on the element nearest to the point (PaperSums.h). That makes the extent of blends,
/// and so the thickness, depend on the sizes of the coarse elements (its Figures 15 and 16), and
/// jumps where the nearest element changes. Here (BlendingKind::Neighbours) what blends is told by
/// the distance along the skeleton between places about half of R apart, in units of R, and the
/// field is a mean of the sums around these (LimbMeans.h). It is smooth, does not depend on how the
/// skeleton is divided, and where the skeleton is straight or bends gently it is exactly the sum of
/// all.
///
/// Immutable: any number of threads may ask one object.
class BlendedField
{
public:
  /// \pre validate() of both. \throws TooLarge
  BlendedField(const ConvolutionKernel& kernel, const BlendingControl& control,
    const GroupedElements& elements);
  BlendedField(BlendedField&&) noexcept;
  ~BlendedField();

  const ConvolutionKernel& kernel() const { return whole_.kernel(); }
  /// Of all elements, without blending control.
  const ConvolutionField& sum() const { return whole_; }

  Box3 influenceBounds() const { return whole_.influenceBounds(); }

  /// Of a piece of the skeleton, on average: how many others it is compared with; 0 unless
  /// BlendingKind::Neighbours.
  double meanNeighbours() const;

  /// What reaches the box. Overwrites `selection`.
  void select(const Box3& box, BlendSelection& selection) const;

  ///@{
  /// \param selection of a box that holds the points; null when they may be anywhere.
  void addField(const BlendSelection* selection, PointBatch points, double* sum) const;
  void addFieldAndGradient(
    const BlendSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const;
  ///@}

  /// What G_i of one group alone would make of the field, for points that are known to belong to it
  /// (PaperSums.h): nearly the field, at a part of the cost. Overwrites `value`, and `gradient`
  /// unless null. \pre BlendingKind::Paper.
  void ownSum(
    std::int32_t group, PointBatch points, double* value, const VectorBatch* gradient) const;

  /// Bounds of the field in a box. \pre the selection is that of the box or of a larger one.
  Interval range(const BlendSelection& selection, const Box3& box) const;

  /// Adds all that the field in some boxes depends on, besides the elements that reach them. \pre
  /// BlendingKind::All, or the compact kernel.
  void describeBlending(const std::vector<Box3>& boxes, Contents& contents) const;

private:
  template <typename Body>
  void forCompactParts(PointBatch points, Body&& body) const;

  ElementGroups elementGroups() const;
  LimbMeans limbs() const; ///< where neighbours blend
  void sumControlled(const BlendSelection& selection, PointBatch points, double* value,
    const VectorBatch* gradient) const;
  Interval paperRange(const BlendSelection& selection, const Box3& box) const;

  ConvolutionField whole_;
  double partSize_; ///< how far apart points may be that are asked for together
  std::vector<std::int32_t> segmentGroups_;
  std::vector<std::int32_t> triangleGroups_;
  std::size_t groupCount_;

  std::unique_ptr<const BlendPieces> pieces_; ///< where neighbours blend; otherwise null
  std::unique_ptr<const PaperSums> paper_;    ///< where they blend as in [SUB]; otherwise null
};

} // namespace hybridtree
