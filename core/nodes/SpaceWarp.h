// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <functional>
#include <memory>

namespace hybridtree
{

/// A deformation w of space and its inverse ([HT] 4.5). Knows points and boxes, no fields.
///
/// w(w^-1(p)) = p for every p that has a preimage. Immutable: one object serves any number of
/// threads.
class SpaceWarp
{
public:
  virtual ~SpaceWarp() = default;

  /// image k = w(p_k). The arrays may be the same.
  virtual void forward(PointBatch points, VectorBatch image) const = 0;

  /// preimage k = w^-1(p_k); NaN where nothing is mapped to p_k. The arrays may be the same.
  virtual void inverse(PointBatch points, VectorBatch preimage) const = 0;

  /// Turns gradients of f at preimages q_k into those of f o w^-1 at w(q_k), in place:
  /// g_k <- J_w(q_k)^-T g_k, which is J_{w^-1}^T g_k ([HT] 4.5.1). Normals likewise, up to length.
  virtual void pullBack(PointBatch preimages, VectorBatch gradient) const = 0;

  /// What inverse() costs for a point, as Node::sampleCost() counts.
  virtual double inverseCost() const = 0;

  /// A box that holds w^-1 of every point of the box: true bounds, which shrink to a point as the
  /// box does wherever w^-1 is continuous.
  virtual Box3 preimageBounds(const Box3& box) const = 0;

  /// A box that holds w of every point of the box.
  virtual Box3 imageBounds(const Box3& box) const = 0;

  /// False when every point of space has a preimage.
  virtual bool mayHaveHoles() const { return false; }
};

using SpaceWarpPtr = std::shared_ptr<const SpaceWarp>;

/// What is known of a map over one cell: the image of its centre, and a box around its whole image.
struct CellImage
{
  Vec3 center;
  Box3 bounds;
};

/// Bounds of the image of a box by branch and bound: cells that could still reach beyond the images
/// found so far by more than 1 % of their diagonal are split, at most `depth` times. Always
/// conservative.
Box3 boundsByCells(
  const Box3& box, const std::function<CellImage(const Box3&)>& imageOf, int depth = 5);

/// The box grown by a few units in the last place, to make up for rounding.
Box3 widened(const Box3& box);

} // namespace hybridtree
