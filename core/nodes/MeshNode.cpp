// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MeshNode.h"

#include "core/base/Error.h"
#include "core/mesh/ContentHash.h"
#include "core/nodes/MeshField.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

class MeshNode final : public Node
{
public:
  MeshNode(
    MeshPtr mesh, double maximumField, double influenceRadius, int exponent, const Affine3& map)
    : field_(std::move(mesh), maximumField, influenceRadius, exponent, map)
  {
  }

  void field(PointBatch points, double* value) const override { field_.field(points, value); }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    field_.fieldAndGradient(points, value, gradient);
  }
  Interval range(const Box3& box) const override { return field_.range(box); }
  FieldSourcePtr restrictedTo(const Box3& box) const override { return field_.restrictedTo(box); }
  void membership(PointBatch points, std::int8_t* side) const override
  {
    field_.membership(points, side);
  }
  void signedDistance(PointBatch points, double* distance) const override
  {
    field_.signedDistance(points, distance);
  }
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override
  {
    std::fill_n(leaf, points.size, 0);
  }
  Box3 influenceBounds() const override { return field_.influenceBounds(); }
  Box3 surfaceBounds() const override { return field_.isNegative() ? Box3() : field_.meshBounds(); }
  bool isNegative() const override { return field_.isNegative(); }

  const char* kind() const override { return "mesh"; }
  Parameters parameters() const override
  {
    Parameters parameters;
    parameters.set("mesh", contentHashText(field_.mesh()).c_str());
    parameters.set("maximumField", field_.maximumField());
    parameters.set("influenceRadius", field_.influenceRadius());
    parameters.set("exponent", field_.exponent());
    parameters.set("map", field_.map());
    return parameters;
  }
  MeshPtr leafMesh() const override { return field_.mesh(); }
  std::optional<SurfaceField> surfaceField() const override
  {
    const double scale = std::cbrt(std::abs(field_.map().linear().determinant()));
    return SurfaceField{ field_.maximumField(), scale * field_.influenceRadius(),
      field_.exponent() };
  }
  bool isFaceted() const override { return true; }
  double sampleCost(double, double edgeLength) const override
  {
    return MeshField::sampleCost(this->trianglesPerSquare(edgeLength));
  }
  std::vector<std::string> warnings() const override { return field_.distance().warnings(); }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override;

  NodePtr makeAffine(const Affine3& map) const override
  {
    return makeMeshNode(field_.mesh(), field_.maximumField(), field_.influenceRadius(),
      field_.exponent(), map * field_.map());
  }

private:
  double trianglesPerSquare(double edgeLength) const;

  MeshField field_;
};

// By half of the area of the box; a square is one edge length wide.
double MeshNode::trianglesPerSquare(double edgeLength) const
{
  const Box3 box = this->surfaceBounds();
  if (box.isEmpty())
  {
    return 0.0;
  }
  const Vec3 side = box.sizes();
  const double area = side.x() * side.y() + side.y() * side.z() + side.z() * side.x();
  const double squares = std::max(area / (edgeLength * edgeLength), 1.0);
  return static_cast<double>(field_.mesh()->triangles.size()) / squares;
}

// The mesh itself: the edge length only matters to nodes that make triangles.
TriangleMesh MeshNode::makeMesh(double, const Progress& progress) const
{
  progress.check();
  TriangleMesh result;
  if (field_.isNegative())
  {
    return result;
  }
  const TriangleMesh& leaf = *field_.mesh();
  const Affine3& map = field_.map();
  result.points = leaf.points;
  result.triangles = leaf.triangles;
  result.normals = field_.distance().vertexNormals();
  if (map.matrix() != Affine3::Identity().matrix())
  {
    const bool mirrored = map.linear().determinant() < 0.0;
    const Mat3 normalMap = map.linear().inverse().transpose();
    for (std::size_t k = 0; k < result.points.size(); ++k)
    {
      result.points[k] = map * result.points[k];
      result.normals[k] = (normalMap * result.normals[k]).stableNormalized();
    }
    if (mirrored)
    {
      for (Triangle& corner : result.triangles)
      {
        std::swap(corner[1], corner[2]);
      }
    }
  }
  result.sourceLeaf.assign(result.triangles.size(), 0);
  result.sourceTriangle.resize(result.triangles.size());
  result.vertexOrigin.resize(result.points.size());
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
  {
    const std::int32_t triangle = std::int32_t(t);
    result.sourceTriangle[t] = triangle;
    const Triangle& corner = leaf.triangles[t];
    result.vertexOrigin[std::size_t(corner[0])] = { 0, triangle, 0.0, 0.0 };
    result.vertexOrigin[std::size_t(corner[1])] = { 0, triangle, 1.0, 0.0 };
    result.vertexOrigin[std::size_t(corner[2])] = { 0, triangle, 0.0, 1.0 };
  }
  return result;
}

} // namespace

NodePtr makeMeshNode(
  MeshPtr mesh, double maximumField, double influenceRadius, int exponent, const Affine3& map)
{
  return std::make_shared<const MeshNode>(
    std::move(mesh), maximumField, influenceRadius, exponent, map);
}

double defaultInfluenceRadius(const TriangleMesh& mesh)
{
  const Box3 box = mesh.bounds();
  const double diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
  return diagonal > 0.0 ? diagonal / 10.0 : 1.0;
}

NodePtr meshFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup)
{
  requireChildren("mesh", children, 0);
  const std::string hash = parameters.getString("mesh");
  MeshPtr mesh = lookup ? lookup(hash) : nullptr;
  if (!mesh)
  {
    throw InvalidText("The tree has a mesh leaf with content hash " + hash +
      ", but no such mesh came with it. Load the file that was written with the tree.");
  }
  return makeMeshNode(std::move(mesh), parameters.getDouble("maximumField"),
    parameters.getDouble("influenceRadius"), parameters.getInt("exponent"),
    parameters.getAffine("map"));
}

} // namespace hybridtree
