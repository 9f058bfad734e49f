// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/DeformedMeshNode.h"

#include "core/base/Scratch.h"
#include "core/nodes/Deformation.h"
#include "core/nodes/WarpImage.h"
#include "core/nodes/WarpMesh.h"
#include "core/polygonize/Polygonize.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybridtree
{
namespace
{

// Turns a carving field round, so that its level -T can be meshed.
class NegatedField final : public FieldSource
{
public:
  explicit NegatedField(const FieldSource& source) : source_(&source) {}
  explicit NegatedField(FieldSourcePtr part) : part_(std::move(part)), source_(part_.get()) {}

  void field(PointBatch points, double* value) const override
  {
    source_->field(points, value);
    negate(value, points.size);
  }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    source_->fieldAndGradient(points, value, gradient);
    for (double* numbers : { value, gradient.x, gradient.y, gradient.z })
    {
      negate(numbers, points.size);
    }
  }
  Interval range(const Box3& box) const override
  {
    const Interval range = source_->range(box);
    return { -range.max, -range.min };
  }
  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    FieldSourcePtr part = source_->restrictedTo(box);
    return part ? std::make_shared<const NegatedField>(std::move(part)) : nullptr;
  }

private:
  static void negate(double* numbers, std::size_t count)
  {
    std::transform(numbers, numbers + count, numbers, [](double number) { return -number; });
  }

  FieldSourcePtr part_;
  const FieldSource* source_;
};

// I, n and R of a deformed shape of several leaves; R a tenth of the diagonal of its bounds.
SurfaceField defaultSurfaceField(const Node& child, const Box3& bounds)
{
  const double diagonal = bounds.isEmpty() ? 1.0 : bounds.diagonal().norm();
  return { child.isNegative() ? -1.0 : 1.0, std::max(diagonal / 10.0, 1e-300), 2 };
}

// In folds the triangles are turned over against J^-T n; what is drawn follows the triangles.
void alignNormals(TriangleMesh& mesh)
{
  const std::vector<Vec3> facing = pointNormals(mesh);
  for (std::size_t k = 0; k < mesh.normals.size(); ++k)
  {
    if (mesh.normals[k].dot(facing[k]) < 0.0)
    {
      mesh.normals[k] = facing[k];
    }
  }
}

} // namespace

// --- the mesh
// -------------------------------------------------------------------------------------

DeformedMesh::DeformedMesh(NodePtr child, FreeFormSetting setting)
  : child_(std::move(child))
  , setting_(std::move(setting))
  , bounds_(setting_.warp->imageBounds(
      child_->isNegative() ? child_->influenceBounds() : child_->surfaceBounds()))
  , surfaceField_(child_->surfaceField().value_or(defaultSurfaceField(*child_, bounds_)))
{
}

MeshPtr DeformedMesh::mesh(const Progress& progress) const
{
  // Held while meshing, as in Node::mesh().
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!mesh_)
  {
    mesh_ = std::make_shared<const TriangleMesh>(this->makeMesh(progress));
  }
  return mesh_;
}

TriangleMesh DeformedMesh::makeMesh(const Progress& progress) const
{
  const ProgressPart before(progress, 0.0, 0.5);
  const ProgressPart after(progress, 0.5, 1.0);
  double edgeLength = setting_.edgeLength;
  if (child_->isNegative())
  {
    // Its own mesh is empty: it is the level -T that is deformed.
    const Box3 box = child_->influenceBounds();
    edgeLength = edgeLength > 0.0 ? edgeLength : box.diagonal().norm() / 100.0;
    PolygonizeOptions options;
    options.cellSize = edgeLength;
    const NegatedField negated(*child_);
    const TriangleMesh source = polygonize(negated, box, options, before);
    return this->imageOfMesh(source, edgeLength, after);
  }
  edgeLength = edgeLength > 0.0 ? edgeLength : child_->defaultEdgeLength();
  const Deformation deformation(*setting_.warp, Deformation::If::Always);
  const MeshPtr source = child_->meshToDeform(edgeLength, deformation, before);
  TriangleMesh mesh = this->imageOfMesh(*source, edgeLength, after);
  alignNormals(mesh);
  return mesh;
}

TriangleMesh DeformedMesh::imageOfMesh(
  const TriangleMesh& mesh, double edgeLength, const Progress& progress) const
{
  return warpedMesh(mesh, imageOf(*setting_.warp, mesh.points, progress), *setting_.warp,
    edgeLength, *child_, progress);
}

// --- the node
// -------------------------------------------------------------------------------------

DeformedMeshNode::DeformedMeshNode(std::shared_ptr<const DeformedMesh> shape, const Affine3& map)
  : Operator({ shape->child() }), shape_(std::move(shape)), map_(map)
{
}

// Null when there is no surface, and so no field.
const MeshField* DeformedMeshNode::meshField(const Progress& progress) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!field_)
  {
    MeshPtr mesh = shape_->mesh(progress);
    if (mesh->empty())
    {
      return nullptr;
    }
    const SurfaceField& field = shape_->surfaceField();
    field_ = std::make_unique<const MeshField>(
      std::move(mesh), field.maximumField, field.influenceRadius, field.exponent, map_);
  }
  return field_.get();
}

void DeformedMeshNode::field(PointBatch points, double* value) const
{
  if (const MeshField* field = this->meshField())
  {
    field->field(points, value);
    return;
  }
  std::fill_n(value, points.size, 0.0);
}

void DeformedMeshNode::fieldAndGradient(
  PointBatch points, double* value, VectorBatch gradient) const
{
  if (const MeshField* field = this->meshField())
  {
    field->fieldAndGradient(points, value, gradient);
    return;
  }
  for (double* numbers : { value, gradient.x, gradient.y, gradient.z })
  {
    std::fill_n(numbers, points.size, 0.0);
  }
}

Interval DeformedMeshNode::range(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return { 0.0, 0.0 };
  }
  const MeshField* field = this->meshField();
  return field ? field->range(box) : Interval{ 0.0, 0.0 };
}

FieldSourcePtr DeformedMeshNode::restrictedTo(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return nullptr;
  }
  const MeshField* field = this->meshField();
  return field ? field->restrictedTo(box) : nullptr;
}

void DeformedMeshNode::membership(PointBatch points, std::int8_t* side) const
{
  if (const MeshField* field = this->meshField())
  {
    field->membership(points, side);
    return;
  }
  std::fill_n(side, points.size, std::int8_t(-1));
}

void DeformedMeshNode::signedDistance(PointBatch points, double* distance) const
{
  const MeshField* field = this->meshField();
  if (field && !this->isNegative())
  {
    field->signedDistance(points, distance);
    return;
  }
  Node::signedDistance(points, distance);
}

void DeformedMeshNode::sourceLeaf(PointBatch points, std::int32_t* leaf) const
{
  const MeshField* field = this->meshField();
  if (!field || this->leafCount() == 1)
  {
    std::fill_n(leaf, points.size, field ? 0 : -1);
    return;
  }
  ScratchArray distance(points.size);
  ScratchVectors nearest(points.size);
  field->nearestTriangle(points, distance.data(), leaf, nearest.batch());
  const std::vector<std::int32_t>& leaves = field->mesh()->sourceLeaf;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    leaf[k] = leaf[k] >= 0 && !leaves.empty() ? leaves[static_cast<std::size_t>(leaf[k])] : -1;
  }
}

Box3 DeformedMeshNode::influenceBounds() const
{
  const Box3 box = shape_->bounds();
  if (box.isEmpty())
  {
    return box;
  }
  const double reach = shape_->surfaceField().influenceRadius;
  return transformed(Box3(Vec3(box.min().array() - reach), Vec3(box.max().array() + reach)), map_);
}

Box3 DeformedMeshNode::surfaceBounds() const
{
  return this->isNegative() ? Box3() : transformed(shape_->bounds(), map_);
}

std::optional<SurfaceField> DeformedMeshNode::surfaceField() const
{
  SurfaceField field = shape_->surfaceField();
  field.influenceRadius *= std::cbrt(std::abs(map_.linear().determinant()));
  return field;
}

Parameters DeformedMeshNode::parameters() const
{
  Parameters parameters = shape_->setting().parameters();
  parameters.set("map", map_);
  return parameters;
}

TriangleMesh DeformedMeshNode::makeMesh(double, const Progress& progress) const
{
  if (this->isNegative())
  {
    return {};
  }
  TriangleMesh mesh = *shape_->mesh(progress);
  if (map_.matrix() == Affine3::Identity().matrix())
  {
    return mesh;
  }
  const Mat3 normalMap = map_.linear().inverse().transpose();
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    mesh.points[k] = map_ * mesh.points[k];
  }
  for (Vec3& normal : mesh.normals)
  {
    normal = (normalMap * normal).stableNormalized();
  }
  if (map_.linear().determinant() < 0.0)
  {
    for (Triangle& corner : mesh.triangles)
    {
      std::swap(corner[1], corner[2]);
    }
  }
  return mesh;
}

NodePtr DeformedMeshNode::makeImage(const Affine3& map) const
{
  return std::make_shared<const DeformedMeshNode>(shape_, map * map_);
}

NodePtr DeformedMeshNode::withChildren(std::vector<NodePtr> children) const
{
  return std::make_shared<const DeformedMeshNode>(
    std::make_shared<const DeformedMesh>(std::move(children.front()), shape_->setting()), map_);
}

} // namespace hybridtree
