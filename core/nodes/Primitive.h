// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"
#include "core/nodes/Potential.h"
#include "core/skeletons/Skeleton.h"

#include <memory>
#include <optional>

namespace hybridtree
{

/// Leaf: a skeleton with a potential, f(p) = g(d(M^-1 p)) ([HT] 4.1), M being the identity for all
/// but images under non-similarities.
///
/// The surface is where d = r_T: none when |I| < T, the skeleton itself when |I| = T. A negative
/// primitive has no surface of its own: it only carves where something blends with it ([HT] 4.3).
class Primitive : public Node
{
public:
  Primitive(SkeletonPtr skeleton, const Potential& potential);

  const Skeleton& skeleton() const { return *skeleton_; }
  const Potential& potential() const { return potential_; }
  /// From the space of skeleton and potential to that of the node; empty for the identity.
  std::optional<Affine3> map() const;

  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  void addField(PointBatch points, double* sum) const override;
  void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;

  /// By the signed distance to the skeleton: inside a volume skeleton is inside for every r_T.
  void membership(PointBatch points, std::int8_t* side) const override;

  /// d - r_T. Inside a volume skeleton d is negative there and the value exact too. NaN under a
  /// non-similarity, where there is no surface, and inside of one beyond the skeleton's reach().
  void signedDistance(PointBatch points, double* distance) const override;

  /// 0 within the influence, -1 beyond.
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override;

  Box3 influenceBounds() const override;
  Box3 surfaceBounds() const override;
  bool isNegative() const override { return potential_.isNegative(); }
  std::optional<SurfaceField> surfaceField() const override;

  const char* kind() const override { return "primitive"; }
  double sampleCost(double, double) const override { return skeleton_->distanceCost(); }
  /// "skeleton" (its kind) with the skeleton's own, those of the potential, "map" where there is
  /// one.
  Parameters parameters() const override;

protected:
  struct Placement
  {
    Affine3 map; ///< from the space of skeleton and potential to that of the node
    Affine3 inverse;
  };

  /// The skeleton's direct mesh ([HT] 5.1), mapped and mended where there is a matrix; the
  /// lattice's for offsets that meet themselves.
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override;
  NodePtr makeAffine(const Affine3& map) const override;

private:
  /// Null for the identity. Other maps are a matter of the few primitives that have one.
  virtual const Placement* placement() const { return nullptr; }

  bool hasSurface() const { return potential_.surfaceRadius() && !this->isNegative(); }
  Box3 offsetBounds(double radius) const;
  Box3 toOwnSpace(const Box3& box) const;

  void projectOntoSurface(std::vector<Vec3>& points, std::vector<Vec3>& normals) const;

  // No more than it takes: a tree of 250 primitives is to fit into 64 KiB ([HT] 6.3). Bounds and
  // the surface radius are cheap beside a batch of points.
  SkeletonPtr skeleton_;
  Potential potential_;
};

/// A primitive, or its image under a map: similarities are absorbed by skeleton and potential,
/// other maps stay in the leaf ([HT] 4.5.3). \throws InvalidParameter without a skeleton, or for a
/// map that is not finite or not invertible.
NodePtr makePrimitive(
  SkeletonPtr skeleton, const Potential& potential, const Affine3& map = Affine3::Identity());

/// NodeMaker: the primitive that Primitive::parameters() describes, with exactly its numbers.
/// \throws InvalidText, InvalidParameter.
NodePtr primitiveFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree
