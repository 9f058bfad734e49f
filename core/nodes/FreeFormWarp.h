// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/BernsteinDeformation.h"
#include "core/nodes/SpaceWarp.h"

namespace hybridtree
{

/// A free-form deformation of the unit cube in a frame: w = frame o D o frame^-1. The frame may be
/// any invertible one, so that the image under an affine map A is the same deformation, with all it
/// has computed, in the frame A * frame.
///
/// inverse(), preimageBounds() and mayHaveHoles() are meant for deformations that do not fold;
/// where it folds, they speak of one of the preimages.
class FreeFormWarp final : public SpaceWarp
{
public:
  FreeFormWarp(std::shared_ptr<const BernsteinDeformation> deformation, const Affine3& frame);

  void forward(PointBatch points, VectorBatch image) const override;
  void inverse(PointBatch points, VectorBatch preimage) const override;
  void pullBack(PointBatch preimages, VectorBatch gradient) const override;
  double inverseCost() const override { return 1.4; }
  Box3 preimageBounds(const Box3& box) const override;
  Box3 imageBounds(const Box3& box) const override;
  bool mayHaveHoles() const override { return !deformation_->hasRestingFaces(); }

  const std::shared_ptr<const BernsteinDeformation>& deformation() const { return deformation_; }
  const Affine3& frame() const { return frame_; }
  /// From world to the unit cube.
  const Affine3& frameInverse() const { return frameInverse_; }

private:
  std::shared_ptr<const BernsteinDeformation> deformation_;
  Affine3 frame_;
  Affine3 frameInverse_;
};

} // namespace hybridtree
