// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BendMap.h"
#include "core/nodes/SpaceWarp.h"
#include "core/nodes/TaperMap.h"
#include "core/nodes/TwistMap.h"

namespace hybridtree
{

/// A Barr map in a frame: w = frame o map o frame^-1. The frame may be scaled, mirrored or sheared,
/// so that the image under any affine map A is the same map in the frame A * frame.
template <typename Map>
class FramedWarp final : public SpaceWarp
{
public:
  /// \pre frame invertible.
  FramedWarp(const Map& map, const Affine3& frame);

  void forward(PointBatch points, VectorBatch image) const override;
  void inverse(PointBatch points, VectorBatch preimage) const override;
  void pullBack(PointBatch preimages, VectorBatch gradient) const override;
  double inverseCost() const override { return Map::kInverseCost; }
  Box3 preimageBounds(const Box3& box) const override;
  Box3 imageBounds(const Box3& box) const override;

  const Map& map() const { return map_; }
  const Affine3& frame() const { return frame_; }
  const Affine3& frameInverse() const { return frameInverse_; }

private:
  Map map_;
  Affine3 frame_;
  Affine3 frameInverse_;
};

extern template class FramedWarp<TwistMap>;
extern template class FramedWarp<TaperMap>;
extern template class FramedWarp<BendMap>;

} // namespace hybridtree
