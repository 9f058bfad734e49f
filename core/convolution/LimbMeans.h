// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendGroups.h"
#include "core/convolution/BlendPieces.h"
#include "core/convolution/BlendSelection.h"

namespace hybridtree
{

/// The field of a skeleton of which only what is near along it blends: with pieces c, e of the
/// skeleton at the distance d(c, e) from each other (PieceGraph.h),
///
///   S = sum of w_c G_c / sum of w_c,  w_c = f_c H_c^20,
///   G_c = sum over e of alpha(d(c, e)) f_e,  H_c = sum over e of beta(d(c, e)) f_e,
///
/// a mean of the sums around all pieces in which those count whose own limb is strong. Along a limb
/// f_c changes slowly and H_c hardly, so nothing jumps from piece to piece; from limb to limb the
/// power decides. S is never more than the sum F of all f_e, and F where all that reach a point are
/// within the distance of full blending of each other.
///
/// Where the kernel ends, F - S is found, from the few pairs that do not blend fully; at points
/// that no such pair reaches S is F, from whole elements, at what that costs. Otherwise only those
/// limbs are integrated that share with one that may have weight.
///
/// Before the fading of the Cauchy kernel. Looks at what it is made of: lives no longer than that.
class LimbMeans
{
public:
  LimbMeans(const ConvolutionField& whole, const ElementGroups& groups, const BlendPieces& pieces);

  /// What is to know of a box whose elements are in selection.all.
  void select(const Box3& box, BlendSelection& selection) const;

  /// Overwrites `value`, and `gradient` unless null. \pre selection.isControlled, and the selection
  /// is that of a box that holds the points.
  void evaluate(const BlendSelection& selection, PointBatch points, double* value,
    const VectorBatch* gradient) const;

  /// Of the field. \pre selection.isControlled, of the box or a larger one.
  Interval range(const BlendSelection& selection, const Box3& box) const;

private:
  class Local;

  const ConvolutionField& whole_;
  ElementGroups groups_;
  const BlendPieces& pieces_;
};

} // namespace hybridtree
