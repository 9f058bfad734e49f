// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Primitive.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/mesh/Remesh.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/LocalPoints.h"
#include "core/nodes/MappedMesh.h"
#include "core/skeletons/SkeletonFactory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

// Distances at coordinates of this size carry rounding of this order.
double roundingAt(const Box3& box)
{
  return 1e-14 * (box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff());
}

// Slope of the signed distance, by differences: the gradient that skeletons give ends at their
// boundary.
Vec3 slopeInside(const Skeleton& skeleton, const Vec3& p, double step)
{
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 a = p - step * Vec3::Unit(axis);
    const Vec3 b = p + step * Vec3::Unit(axis);
    double before, after;
    skeleton.signedDistance({ &a.x(), &a.y(), &a.z(), 1 }, &before);
    skeleton.signedDistance({ &b.x(), &b.y(), &b.z(), 1 }, &after);
    slope[axis] = after - before;
  }
  return slope.norm() > 0.0 ? Vec3(slope.normalized()) : slope;
}

// Moves a point near an offset surface onto it, and says which way is out. One step, unless the
// point is inside the skeleton or the surface has grown into itself: then what was nearest may
// change on the way.
Vec3 stepOntoOffset(const Skeleton& skeleton, double radius, Vec3& p)
{
  constexpr int kMostSteps = 40;
  const double size = skeleton.bounds().diagonal().norm() + radius;
  Vec3 outward = Vec3::Zero();
  for (int step = 0; step < kMostSteps; ++step)
  {
    double distance;
    skeleton.distanceAndGradient(
      { &p.x(), &p.y(), &p.z(), 1 }, &distance, { &outward.x(), &outward.y(), &outward.z() });
    const bool within = distance == 0.0;
    if (within)
    {
      skeleton.signedDistance({ &p.x(), &p.y(), &p.z(), 1 }, &distance);
      outward = distance == radius ? outward : slopeInside(skeleton, p, 1e-7 * size);
    }
    const double over = distance - radius;
    p -= over * outward;
    if (std::abs(over) <= 1e-15 * size || (!within && radius < skeleton.reach()))
    {
      break;
    }
  }
  return outward;
}

// Under a map that is no similarity.
class MappedPrimitive final : public Primitive
{
public:
  MappedPrimitive(SkeletonPtr skeleton, const Potential& potential, const Affine3& map)
    : Primitive(std::move(skeleton), potential), placement_{ map, map.inverse() }
  {
  }

private:
  const Placement* placement() const override { return &placement_; }

  Placement placement_;
};

} // namespace

Primitive::Primitive(SkeletonPtr skeleton, const Potential& potential)
  : skeleton_(std::move(skeleton)), potential_(potential)
{
}

std::optional<Affine3> Primitive::map() const
{
  const Placement* placement = this->placement();
  return placement ? std::optional<Affine3>(placement->map) : std::nullopt;
}

Box3 Primitive::influenceBounds() const
{
  return this->offsetBounds(potential_.influenceRadius());
}

Box3 Primitive::surfaceBounds() const
{
  return this->hasSurface() ? this->offsetBounds(*potential_.surfaceRadius()) : Box3();
}

Box3 Primitive::toOwnSpace(const Box3& box) const
{
  const Placement* placement = this->placement();
  return placement ? transformed(box, placement->inverse) : box;
}

Box3 Primitive::offsetBounds(double radius) const
{
  const Placement* placement = this->placement();
  Box3 box = skeleton_->bounds();
  Vec3 reach = Vec3::Constant(radius);
  if (placement)
  {
    // The ball of the offset becomes an ellipsoid, whose extent along an axis is the length of that
    // row of the matrix.
    box = transformed(box, placement->map);
    reach = radius * placement->map.linear().rowwise().norm();
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
  const Placement* placement = this->placement();
  if (placement)
  {
    skeleton_->addFalloff(LocalPoints(points, &placement->inverse), potential_.falloff(), sum);
    return;
  }
  skeleton_->addFalloff(points, potential_.falloff(), sum);
}

void Primitive::addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const
{
  const Placement* placement = this->placement();
  if (!placement)
  {
    skeleton_->addFalloffWithGradient(points, potential_.falloff(), sum, gradientSum);
    return;
  }
  const LocalPoints local(points, &placement->inverse);
  ScratchVectors own(points.size);
  const VectorBatch gradient = own.batch();
  std::fill_n(gradient.x, points.size, 0.0);
  std::fill_n(gradient.y, points.size, 0.0);
  std::fill_n(gradient.z, points.size, 0.0);
  skeleton_->addFalloffWithGradient(local, potential_.falloff(), sum, gradient);
  const Mat3 transposed = placement->inverse.linear().transpose();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    gradientSum.set(k, gradientSum[k] + transposed * gradient[k]);
  }
}

Interval Primitive::range(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return {};
  }
  return potential_.range(skeleton_->distanceRange(this->toOwnSpace(box)));
}

FieldSourcePtr Primitive::restrictedTo(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return nullptr;
  }
  const Interval distance = skeleton_->distanceRange(this->toOwnSpace(box));
  return distance.min < potential_.influenceRadius() ? this->shared_from_this() : nullptr;
}

void Primitive::membership(PointBatch points, std::int8_t* side) const
{
  const Placement* placement = this->placement();
  if (!this->hasSurface())
  {
    std::fill_n(side, points.size, std::int8_t(-1));
    return;
  }
  const LocalPoints local(points, placement ? &placement->inverse : nullptr);
  ScratchArray distance(points.size);
  skeleton_->signedDistance(local, distance.data());
  const double radius = *potential_.surfaceRadius();
  const double rounding = roundingAt(skeleton_->bounds()) + 1e-14 * radius;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double over = distance[k] - radius;
    side[k] = static_cast<std::int8_t>(over > rounding ? -1 : over < -rounding ? 1 : 0);
  }
}

void Primitive::signedDistance(PointBatch points, double* distance) const
{
  const Placement* placement = this->placement();
  if (placement || !this->hasSurface())
  {
    Node::signedDistance(points, distance);
    return;
  }
  skeleton_->signedDistance(points, distance);
  const double radius = *potential_.surfaceRadius();
  // Inside of an offset that has grown into itself the way back to the skeleton says nothing.
  const bool insideKnown = radius < skeleton_->reach();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double over = distance[k] - radius;
    distance[k] = insideKnown || over >= 0.0 ? over : std::numeric_limits<double>::quiet_NaN();
  }
}

void Primitive::sourceLeaf(PointBatch points, std::int32_t* leaf) const
{
  const Placement* placement = this->placement();
  const LocalPoints local(points, placement ? &placement->inverse : nullptr);
  ScratchArray distance(points.size);
  skeleton_->distance(local, distance.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    leaf[k] = distance[k] < potential_.influenceRadius() ? 0 : -1;
  }
}

std::optional<SurfaceField> Primitive::surfaceField() const
{
  const Placement* placement = this->placement();
  if (!potential_.surfaceRadius())
  {
    return std::nullopt;
  }
  const double scale = placement ? std::cbrt(std::abs(placement->map.linear().determinant())) : 1.0;
  return SurfaceField{ potential_.maximumField(),
    scale * (potential_.influenceRadius() - *potential_.surfaceRadius()), potential_.exponent() };
}

Parameters Primitive::parameters() const
{
  const Placement* placement = this->placement();
  Parameters parameters;
  parameters.set("skeleton", skeleton_->kind());
  const Parameters own = skeleton_->parameters();
  for (const auto& [name, value] : own.entries())
  {
    parameters.set(name, value);
  }
  potential_.describe(parameters);
  if (placement)
  {
    parameters.set("map", placement->map);
  }
  return parameters;
}

TriangleMesh Primitive::makeMesh(double edgeLength, const Progress& progress) const
{
  const Placement* placement = this->placement();
  if (!this->hasSurface())
  {
    return {};
  }
  progress.check();
  const double stretch = placement ? middleStretch(placement->map) : 1.0;
  std::optional<TriangleMesh> direct =
    skeleton_->offsetMesh(*potential_.surfaceRadius(), edgeLength / stretch);
  if (!direct)
  {
    return latticeMesh(*this, edgeLength, progress);
  }
  TriangleMesh mesh = std::move(*direct);
  mesh.sourceLeaf.assign(mesh.triangles.size(), 0);
  if (placement)
  {
    applyMap(placement->map, mesh);
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

void Primitive::projectOntoSurface(std::vector<Vec3>& points, std::vector<Vec3>& normals) const
{
  const Placement* placement = this->placement();
  const double radius = *potential_.surfaceRadius();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    Vec3 p = placement->inverse * points[k];
    const Vec3 outward = stepOntoOffset(*skeleton_, radius, p);
    points[k] = placement->map * p;
    // On a sharp solid the interpolated normals are those to keep.
    if (radius > 0.0)
    {
      normals[k] = (placement->inverse.linear().transpose() * outward).normalized();
    }
  }
}

NodePtr Primitive::makeAffine(const Affine3& map) const
{
  const Placement* placement = this->placement();
  return makePrimitive(skeleton_, potential_, placement ? map * placement->map : map);
}

NodePtr makePrimitive(SkeletonPtr skeleton, const Potential& potential, const Affine3& map)
{
  if (!skeleton)
  {
    throw InvalidParameter("The skeleton of a primitive", "missing", "a skeleton");
  }
  if (map.matrix() == Affine3::Identity().matrix())
  {
    return std::make_shared<Primitive>(std::move(skeleton), potential);
  }
  if (!map.matrix().allFinite() || map.linear().determinant() == 0.0)
  {
    throw InvalidParameter(
      "The map of a primitive", "not finite or not invertible", "an invertible matrix");
  }
  if (const std::optional<double> scale = similarityScale(map))
  {
    return std::make_shared<Primitive>(
      skeleton->similarityImage(map, *scale), potential.scaled(*scale));
  }
  return std::make_shared<MappedPrimitive>(std::move(skeleton), potential, map);
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
