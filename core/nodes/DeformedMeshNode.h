// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/FreeForm.h"
#include "core/nodes/FreeFormWarp.h"
#include "core/nodes/MeshField.h"
#include "core/nodes/Operator.h"

namespace hybridtree
{

/// What makeFreeForm() was asked for, and what all images of a node under affine maps share.
struct FreeFormSetting
{
  std::shared_ptr<const FreeFormWarp> warp;
  FieldFrom fieldFrom; ///< as asked, which folds may overrule
  double edgeLength;   ///< as asked, 0 for the default

  /// Everything of the kind "freeForm" but "map".
  Parameters parameters() const;
  /// On folds and displaced faces.
  /// \param reach bounds of what the lattice should take along.
  std::vector<std::string> warnings(const Box3& reach) const;
};

/// The deformed mesh of a child, made at the first call that needs it and shared by all images of
/// its node under affine maps.
class DeformedMesh
{
public:
  DeformedMesh(NodePtr child, FreeFormSetting setting);

  const NodePtr& child() const { return child_; }
  const FreeFormSetting& setting() const { return setting_; }

  /// Without triangles when the child has no surface. \throws as Node::mesh().
  MeshPtr mesh(const Progress& progress) const;

  ///@{ Known before the mesh is.
  Box3 bounds() const { return bounds_; } ///< holds the mesh
  const SurfaceField& surfaceField() const { return surfaceField_; }
  ///@}

private:
  TriangleMesh makeMesh(const Progress& progress) const;
  TriangleMesh imageOfMesh(
    const TriangleMesh& mesh, double edgeLength, const Progress& progress) const;

  NodePtr child_;
  FreeFormSetting setting_;
  Box3 bounds_;
  SurfaceField surfaceField_;
  mutable std::mutex mutex_;
  mutable MeshPtr mesh_;
};

/// Free-form deformation with the field around the deformed mesh ([HT] 4.5.2): a mesh node once
/// made. Seen through a matrix, as mesh leaves are: affine maps never make the mesh again.
class DeformedMeshNode final : public Operator
{
public:
  DeformedMeshNode(std::shared_ptr<const DeformedMesh> shape, const Affine3& map);

  const DeformedMesh& shape() const { return *shape_; }
  const Affine3& map() const { return map_; }

  void field(PointBatch points, double* value) const override;
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override;
  Interval range(const Box3& box) const override;
  FieldSourcePtr restrictedTo(const Box3& box) const override;
  void membership(PointBatch points, std::int8_t* side) const override;
  void signedDistance(PointBatch points, double* distance) const override;
  /// The leaf of the nearest triangle.
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override;
  Box3 influenceBounds() const override;
  Box3 surfaceBounds() const override;
  bool isNegative() const override { return shape_->surfaceField().maximumField < 0.0; }
  bool isFaceted() const override { return true; }
  std::optional<SurfaceField> surfaceField() const override;

  const char* kind() const override { return "freeForm"; }
  /// Its triangles are about as long as the edges.
  double sampleCost(double, double) const override { return MeshField::sampleCost(1.0); }
  Parameters parameters() const override;
  std::vector<std::string> warnings() const override
  {
    return shape_->setting().warnings(shape_->child()->surfaceBounds());
  }

protected:
  /// The deformed mesh, at any length asked.
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override;
  NodePtr makeImage(const Affine3& map) const override;
  NodePtr withChildren(std::vector<NodePtr> children) const override;

private:
  void prepareField(const Progress& progress) const override { this->meshField(progress); }

  const MeshField* meshField(const Progress& progress = Progress::none()) const;

  std::shared_ptr<const DeformedMesh> shape_;
  Affine3 map_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const MeshField> field_;
};

} // namespace hybridtree
