// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Primitive.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/mesh/Remesh.h"
#include "core/nodes/LatticeMesh.h"
#include "core/skeletons/SkeletonFactory.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Points in the leaf's own space: those given, or their images in scratch memory.
class LocalPoints
{
public:
  LocalPoints(PointBatch points, bool mapped, const Affine3& inverse)
    : scratch_(mapped ? points.size : 0), points_(mapped ? scratch_.points() : points)
  {
    if (mapped)
    {
      const VectorBatch local = scratch_.batch();
      for (std::size_t k = 0; k < points.size; ++k)
      {
        local.set(k, inverse * points[k]);
      }
    }
  }
  operator PointBatch() const { return points_; }

private:
  ScratchVectors scratch_;
  PointBatch points_;
};

// Distances at coordinates of this size carry rounding of this order.
double roundingAt(const Box3& box)
{
  return 1e-14 * (box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff());
}

// The middle one of the factors by which the map stretches three directions at right angles. A mesh
// made finer by it comes out about right in two of them, and is split or thinned in the third.
double middleStretch(const std::optional<Affine3>& map)
{
  return map ? Eigen::JacobiSVD<Mat3>(map->linear()).singularValues()[1] : 1.0;
}

} // namespace

Primitive::Primitive(SkeletonPtr skeleton, const Potential& potential, const Affine3& map)
  : skeleton_(std::move(skeleton))
  , potential_(potential)
  , falloff_(potential.falloff())
  , surfaceRadius_(potential.surfaceRadius())
  , inverse_(Affine3::Identity())
{
  if (map.matrix() != Affine3::Identity().matrix())
  {
    map_ = map;
    inverse_ = map.inverse();
  }
  influenceBounds_ = this->offsetBounds(potential_.influenceRadius());
  if (this->hasSurface())
  {
    surfaceBounds_ = this->offsetBounds(*surfaceRadius_);
  }
}

Box3 Primitive::offsetBounds(double radius) const
{
  Box3 box = skeleton_->bounds();
  Vec3 reach = Vec3::Constant(radius);
  if (map_)
  {
    // The ball of the offset becomes an ellipsoid, whose extent along an axis is the length of that
    // row of the matrix.
    box = transformed(box, *map_);
    reach = radius * map_->linear().rowwise().norm();
  }
  return Box3(Vec3(box.min() - reach), Vec3(box.max() + reach));
}

void Primitive::field(PointBatch points, double* value) const
{
  std::fill_n(value, points.size, 0.0);
  this->addField(points, value);
}

void Primitive::fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const
{
  std::fill_n(value, points.size, 0.0);
  std::fill_n(gradient.x, points.size, 0.0);
  std::fill_n(gradient.y, points.size, 0.0);
  std::fill_n(gradient.z, points.size, 0.0);
  this->addFieldAndGradient(points, value, gradient);
}

void Primitive::addField(PointBatch points, double* sum) const
{
  if (map_)
  {
    skeleton_->addFalloff(LocalPoints(points, true, inverse_), falloff_, sum);
    return;
  }
  skeleton_->addFalloff(points, falloff_, sum);
}

void Primitive::addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const
{
  if (!map_)
  {
    skeleton_->addFalloffWithGradient(points, falloff_, sum, gradientSum);
    return;
  }
  const LocalPoints local(points, true, inverse_);
  ScratchVectors own(points.size);
  const VectorBatch gradient = own.batch();
  std::fill_n(gradient.x, points.size, 0.0);
  std::fill_n(gradient.y, points.size, 0.0);
  std::fill_n(gradient.z, points.size, 0.0);
  skeleton_->addFalloffWithGradient(local, falloff_, sum, gradient);
  const Mat3 transposed = inverse_.linear().transpose();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    gradientSum.set(k, gradientSum[k] + transposed * gradient[k]);
  }
}

Interval Primitive::range(const Box3& box) const
{
  if (!box.intersects(influenceBounds_))
  {
    return {};
  }
  return potential_.range(skeleton_->distanceRange(map_ ? transformed(box, inverse_) : box));
}

FieldSourcePtr Primitive::restrictedTo(const Box3& box) const
{
  if (!box.intersects(influenceBounds_))
  {
    return nullptr;
  }
  const Interval distance = skeleton_->distanceRange(map_ ? transformed(box, inverse_) : box);
  return distance.min < potential_.influenceRadius() ? this->shared_from_this() : nullptr;
}

void Primitive::membership(PointBatch points, std::int8_t* side) const
{
  if (!this->hasSurface())
  {
    std::fill_n(side, points.size, std::int8_t(-1));
    return;
  }
  const LocalPoints local(points, map_.has_value(), inverse_);
  ScratchArray distance(points.size);
  skeleton_->signedDistance(local, distance.data());
  const double radius = *surfaceRadius_;
  const double rounding = roundingAt(skeleton_->bounds()) + 1e-14 * radius;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double over = distance[k] - radius;
    side[k] = static_cast<std::int8_t>(over > rounding ? -1 : over < -rounding ? 1 : 0);
  }
}

void Primitive::signedDistance(PointBatch points, double* distance) const
{
  if (map_ || !this->hasSurface())
  {
    Node::signedDistance(points, distance);
    return;
  }
  skeleton_->signedDistance(points, distance);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] -= *surfaceRadius_;
  }
}

void Primitive::sourceLeaf(PointBatch points, std::int32_t* leaf) const
{
  const LocalPoints local(points, map_.has_value(), inverse_);
  ScratchArray distance(points.size);
  skeleton_->distance(local, distance.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    leaf[k] = distance[k] < potential_.influenceRadius() ? 0 : -1;
  }
}

std::optional<SurfaceField> Primitive::surfaceField() const
{
  if (!surfaceRadius_)
  {
    return std::nullopt;
  }
  const double scale = map_ ? std::cbrt(std::abs(map_->linear().determinant())) : 1.0;
  return SurfaceField{ potential_.maximumField(),
    scale * (potential_.influenceRadius() - *surfaceRadius_), potential_.exponent() };
}

Parameters Primitive::parameters() const
{
  Parameters parameters;
  parameters.set("skeleton", skeleton_->kind());
  const Parameters own = skeleton_->parameters();
  for (const auto& [name, value] : own.entries())
  {
    parameters.set(name, value);
  }
  potential_.describe(parameters);
  if (map_)
  {
    parameters.set("map", *map_);
  }
  return parameters;
}

TriangleMesh Primitive::makeMesh(double edgeLength, const Progress& progress) const
{
  if (!this->hasSurface())
  {
    return {};
  }
  progress.check();
  std::optional<TriangleMesh> direct =
    skeleton_->offsetMesh(*surfaceRadius_, edgeLength / middleStretch(map_));
  if (!direct)
  {
    return latticeMesh(*this, edgeLength, progress);
  }
  TriangleMesh mesh = std::move(*direct);
  mesh.sourceLeaf.assign(mesh.triangles.size(), 0);
  if (map_)
  {
    this->mapMesh(mesh);
    RemeshOptions options;
    options.edgeLength = edgeLength;
    remeshStretched(
      mesh, options,
      [this](std::vector<Vec3>& points, std::vector<Vec3>& normals)
      { this->projectOntoSurface(points, normals); },
      progress);
  }
  return mesh;
}

void Primitive::mapMesh(TriangleMesh& mesh) const
{
  const Mat3 toNormals = inverse_.linear().transpose();
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    mesh.points[k] = *map_ * mesh.points[k];
    mesh.normals[k] = (toNormals * mesh.normals[k]).normalized();
  }
  if (map_->linear().determinant() < 0.0)
  {
    for (Triangle& triangle : mesh.triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

void Primitive::projectOntoSurface(std::vector<Vec3>& points, std::vector<Vec3>& normals) const
{
  const Affine3 map = map_.value_or(Affine3::Identity());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3 p = inverse_ * points[k];
    double distance;
    Vec3 outward;
    skeleton_->distanceAndGradient(
      { &p.x(), &p.y(), &p.z(), 1 }, &distance, { &outward.x(), &outward.y(), &outward.z() });
    points[k] = map * Vec3(p - (distance - *surfaceRadius_) * outward);
    // On a sharp box the interpolated normals are those to keep.
    if (*surfaceRadius_ > 0.0 && distance > 0.0)
    {
      normals[k] = (inverse_.linear().transpose() * outward).normalized();
    }
  }
}

NodePtr Primitive::makeAffine(const Affine3& map) const
{
  return makePrimitive(skeleton_, potential_, map_ ? map * *map_ : map);
}

NodePtr makePrimitive(SkeletonPtr skeleton, const Potential& potential, const Affine3& map)
{
  if (!skeleton)
  {
    throw InvalidParameter("The skeleton of a primitive", "missing", "a skeleton");
  }
  if (map.matrix() == Affine3::Identity().matrix())
  {
    return std::make_shared<Primitive>(std::move(skeleton), potential, map);
  }
  if (!map.matrix().allFinite() || map.linear().determinant() == 0.0)
  {
    throw InvalidParameter(
      "The map of a primitive", "not finite or not invertible", "an invertible matrix");
  }
  if (const std::optional<double> scale = similarityScale(map))
  {
    return std::make_shared<Primitive>(
      skeleton->similarityImage(map, *scale), potential.scaled(*scale), Affine3::Identity());
  }
  return std::make_shared<Primitive>(std::move(skeleton), potential, map);
}

NodePtr primitiveFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("primitive", children, 0);
  const Affine3 map =
    parameters.has("map") ? parameters.getAffine("map") : Affine3(Affine3::Identity());
  return makePrimitive(makeSkeleton(parameters.getString("skeleton"), parameters),
    Potential::fromParameters(parameters), map);
}

} // namespace hybridtree
