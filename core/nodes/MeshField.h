// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshDistance.h"
#include "core/nodes/Potential.h"
#include "core/polygonize/FieldSource.h"

#include <memory>
#include <mutex>

namespace hybridtree
{

/// Potential field around a triangle mesh, with the mesh as its surface ([HT] 4.2).
///
/// The offset pseudo-distance is max(0, r'_T + d), with d the distance to the mesh, negative
/// inside; the potential has radius R' = R / (1 - r_T/R), where r_T/R = r'_T/R' = sqrt(1 -
/// (T/|I|)^(1/n)). So the field is T (-T where I < 0) on the mesh, 0 from distance R on outside,
/// and I from depth r'_T = R' - R on inside.
///
/// Lives in the space of the mesh and is seen through a matrix: the field at map * p is the field
/// of the mesh at p, so R is a length of the mesh's own space. Made in no time: the hierarchy
/// behind it is shared by all fields over one mesh object and built at the first query.
///
/// Over a mesh that is not closed the side comes from the winding number, and the field jumps where
/// that side changes away from the mesh (across the holes).
class MeshField : public FieldSource
{
public:
  /// \param mesh as repairMesh() leaves it.
  /// \param maximumField I, |I| >= T. \param influenceRadius R, > 0. \param exponent n, 2 to 64.
  /// \param map finite and invertible.
  /// \throws InvalidParameter; InvalidGeometry when the mesh is empty.
  MeshField(MeshPtr mesh, double maximumField, double influenceRadius, int exponent,
    const Affine3& map = Affine3::Identity());
  ~MeshField() override;

  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;

  /// 1 inside, 0 on, -1 outside, by the mesh alone (exact where it is closed); always -1 where I <
  /// 0.
  void membership(PointBatch points, std::int8_t* side) const;

  /// Negative inside; NaN unless the map is a similarity.
  void signedDistance(PointBatch points, double* distance) const;

  /// Distance to the mesh in its own space (so only under the identity a world distance), its
  /// nearest triangle and the nearest point in world space; within R, else infinity, -1 and NaN.
  void nearestTriangle(
    PointBatch points, double* distance, std::int32_t* triangle, VectorBatch nearestPoint) const;

  const Box3& influenceBounds() const
  {
    return influence_;
  }                                                  ///< of the mesh grown by R, under the map
  const Box3& meshBounds() const { return bounds_; } ///< of the mesh under the map: tight

  const MeshPtr& mesh() const { return mesh_; }
  const Affine3& map() const { return map_; }
  double maximumField() const { return potential_.maximumField(); }
  double influenceRadius() const { return influenceRadius_; } ///< R, not R'
  int exponent() const { return potential_.exponent(); }
  bool isNegative() const { return potential_.isNegative(); }

  /// What a value costs, as Node::sampleCost() counts: to find where to look, and more where many
  /// triangles are near. \param density triangles in a square of the edge length, >= 0.
  static double sampleCost(double density);

  /// The hierarchy; built if it was not.
  const MeshDistance& distance() const;

private:
  class Part;
  friend class Part;

  void evaluate(PointBatch points, double* value, VectorBatch gradient, const MeshPart* part) const;
  void evaluateBatch(
    PointBatch points, double* value, VectorBatch gradient, const MeshPart* part) const;
  Box3 toMeshSpace(const Box3& box) const;
  Interval fieldRange(const Interval& signedRange) const;

  MeshPtr mesh_;
  double influenceRadius_;
  Potential potential_; // of radius R'
  double offset_;       // r'_T
  Affine3 map_;
  Affine3 inverse_;
  bool identity_;
  Box3 influence_;
  Box3 bounds_;
  mutable std::once_flag once_;
  mutable std::shared_ptr<const MeshDistance> distance_;
};

} // namespace hybridtree
