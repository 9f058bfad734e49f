// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Operator.h"
#include "core/nodes/SpaceWarp.h"

namespace hybridtree
{

/// A child shape deformed by a warp with a computable inverse ([HT] 4.5.1): f = f_A o w^-1,
/// grad f = J_{w^-1}^T grad f_A, membership that of A at w^-1(p). 0 where nothing is mapped to.
///
/// What all such nodes share; the subclass adds its kind, its parameters and its affine image.
class WarpedNode : public Operator
{
public:
  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;
  void membership(PointBatch points, std::int8_t* side) const override;
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override;
  Box3 influenceBounds() const override;
  Box3 surfaceBounds() const override;
  bool isNegative() const override { return child_->isNegative(); }
  double sampleCost(double below, double) const override { return below + warp_->inverseCost(); }

protected:
  /// \pre both not null.
  WarpedNode(NodePtr child, SpaceWarpPtr warp);

  const SpaceWarp& warp() const { return *warp_; }

  /// The child's mesh, refined where the warp stretches it, mapped, and its triangles mended. Where
  /// the warp is not one-to-one on it, the field is meshed on the lattice instead.
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override;

  /// The image of another mesh of the child, where that is the cheaper one for this map and those
  /// above it together.
  MeshPtr findOtherMesh(
    double edgeLength, const Deformation& by, const Progress& progress) const override;

private:
  TriangleMesh imageOfMesh(
    const TriangleMesh& source, double edgeLength, const Progress& progress) const;

  const Node* child_;
  SpaceWarpPtr warp_;
  // Found when asked for: a chain of affine maps need not find those of every image between.
  mutable std::once_flag influenceOnce_;
  mutable std::once_flag surfaceOnce_;
  mutable Box3 influenceBounds_;
  mutable Box3 surfaceBounds_;
};

} // namespace hybridtree
