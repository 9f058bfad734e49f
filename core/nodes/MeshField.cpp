// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MeshField.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace hybridtree
{
namespace
{

// R' of [HT] 4.2.
Potential widened(double maximumField, double influenceRadius, int exponent)
{
  const Potential given(maximumField, influenceRadius, exponent);
  const std::optional<double> surface = given.surfaceRadius();
  if (!surface)
  {
    throw InvalidParameter("MaximumField", maximumField,
      "at least 0.5 (or at most -0.5 to carve), or the mesh could not be the surface");
  }
  const double share = *surface / influenceRadius;
  return Potential(maximumField, influenceRadius / (1.0 - share), exponent);
}

void toMesh(const Affine3& inverse, PointBatch points, VectorBatch local)
{
  const auto& m = inverse.matrix();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double x = points.x[k];
    const double y = points.y[k];
    const double z = points.z[k];
    local.x[k] = m(0, 0) * x + m(0, 1) * y + m(0, 2) * z + m(0, 3);
    local.y[k] = m(1, 0) * x + m(1, 1) * y + m(1, 2) * z + m(1, 3);
    local.z[k] = m(2, 0) * x + m(2, 1) * y + m(2, 2) * z + m(2, 3);
  }
}

constexpr std::size_t kBatch = 16384; // points a task: MeshDistance gains from company

} // namespace

/// The field where everything near is the inside: I.
class DeepInside final : public FieldSource
{
public:
  explicit DeepInside(double value) : value_(value) {}
  void field(PointBatch points, double* value) const override
  {
    std::fill_n(value, points.size, value_);
  }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    this->field(points, value);
    std::fill_n(gradient.x, points.size, 0.0);
    std::fill_n(gradient.y, points.size, 0.0);
    std::fill_n(gradient.z, points.size, 0.0);
  }
  Interval range(const Box3&) const override { return { value_, value_ }; }
  FieldSourcePtr restrictedTo(const Box3&) const override
  {
    return std::make_shared<DeepInside>(value_);
  }

private:
  double value_;
};

/// The field in one box, by the triangles that can be nearest there. They are looked for when the
/// first point is asked: many boxes are only halved further.
class MeshField::Part final : public FieldSource
{
public:
  /// \param box and the same in the space of the mesh. \param range of the field there.
  /// \param reach largest distance that matters there.
  Part(const MeshField& whole, const Box3& box, const Box3& local, Interval range, double reach)
    : whole_(whole), box_(box), local_(local), range_(range), reach_(reach)
  {
  }
  void field(PointBatch points, double* value) const override
  {
    whole_.evaluate(points, value, {}, &this->part());
  }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    whole_.evaluate(points, value, gradient, &this->part());
  }
  Interval range(const Box3& box) const override
  {
    const bool same = box.min() == box_.min() && box.max() == box_.max();
    return same ? range_ : whole_.range(box);
  }
  FieldSourcePtr restrictedTo(const Box3& box) const override { return whole_.restrictedTo(box); }

private:
  const MeshPart& part() const
  {
    std::call_once(found_, [this] { part_ = whole_.distance().within(local_, reach_); });
    return part_;
  }

  const MeshField& whole_;
  const Box3 box_;
  const Box3 local_; ///< the same in the space of the mesh
  const Interval range_;
  const double reach_;
  mutable std::once_flag found_;
  mutable MeshPart part_;
};

MeshField::MeshField(
  MeshPtr mesh, double maximumField, double influenceRadius, int exponent, const Affine3& map)
  : mesh_(std::move(mesh))
  , influenceRadius_(influenceRadius)
  , potential_(widened(maximumField, influenceRadius, exponent))
  , offset_(potential_.influenceRadius() - influenceRadius)
  , map_(map)
  , inverse_(map.inverse())
  , identity_(map.matrix() == Affine3::Identity().matrix())
{
  if (!mesh_ || mesh_->empty())
  {
    throw InvalidGeometry("The mesh has no triangles: a mesh leaf needs a surface.");
  }
  const Box3 own = mesh_->bounds();
  const Vec3 reach = Vec3::Constant(influenceRadius_);
  influence_ = transformed(Box3(Vec3(own.min() - reach), Vec3(own.max() + reach)), map_);
  for (const Vec3& point : mesh_->points)
  {
    bounds_.extend(identity_ ? point : Vec3(map_ * point));
  }
}

MeshField::~MeshField() = default;

double MeshField::sampleCost(double density)
{
  constexpr double kWhere = 0.25;
  constexpr double kDensity = 0.61;
  return kWhere + kDensity * std::sqrt(density);
}

const MeshDistance& MeshField::distance() const
{
  std::call_once(once_, [&] { distance_ = sharedMeshDistance(mesh_); });
  return *distance_;
}

void MeshField::evaluate(
  PointBatch points, double* value, VectorBatch gradient, const MeshPart* part) const
{
  this->distance(); // not inside the loop: building it is parallel itself
  parallelFor(points.size, kBatch,
    [&](std::size_t begin, std::size_t end)
    {
      this->evaluateBatch(points.slice(begin, end - begin), value + begin,
        gradient.x ? gradient.slice(begin) : VectorBatch{}, part);
    });
}

void MeshField::evaluateBatch(
  PointBatch points, double* value, VectorBatch gradient, const MeshPart* part) const
{
  ScratchVectors mapped(identity_ ? 0 : points.size);
  if (!identity_)
  {
    toMesh(inverse_, points, mapped.batch());
    points = mapped.points();
  }
  ScratchArray distance(points.size);
  // Out of reach, the distance is infinite: r'_T deep or more inside, R' outside.
  distance_->signedDistance(
    points, std::max(influenceRadius_, offset_), distance.data(), gradient, part);
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] = std::clamp(distance[k] + offset_, 0.0, potential_.influenceRadius());
  }
  if (!gradient.x)
  {
    potential_.evaluate(distance.data(), value, points.size);
    return;
  }
  ScratchArray slope(points.size);
  potential_.evaluateWithSlope(distance.data(), value, slope.data(), points.size);
  const Mat3 normalMap = inverse_.linear().transpose();
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 own = slope[k] * gradient[k];
    gradient.set(k, identity_ ? own : Vec3(normalMap * own));
  }
}

void MeshField::field(PointBatch points, double* value) const
{
  this->evaluate(points, value, {}, nullptr);
}

void MeshField::fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const
{
  this->evaluate(points, value, gradient, nullptr);
}

Box3 MeshField::toMeshSpace(const Box3& box) const
{
  return identity_ ? box : transformed(box, inverse_);
}

Interval MeshField::range(const Box3& box) const
{
  if (!box.intersects(influence_))
  {
    return { 0.0, 0.0 };
  }
  const Box3 local = this->toMeshSpace(box);
  if (local.squaredExteriorDistance(this->distance().bounds()) >=
    influenceRadius_ * influenceRadius_)
  {
    return { 0.0, 0.0 };
  }
  return this->fieldRange(this->distance().signedRange(local));
}

Interval MeshField::fieldRange(const Interval& signedRange) const
{
  return potential_.range(
    { std::max(0.0, signedRange.min + offset_), std::max(0.0, signedRange.max + offset_) });
}

FieldSourcePtr MeshField::restrictedTo(const Box3& box) const
{
  if (!box.intersects(influence_))
  {
    return nullptr;
  }
  const Box3 local = this->toMeshSpace(box);
  if (local.squaredExteriorDistance(this->distance().bounds()) >=
    influenceRadius_ * influenceRadius_)
  {
    return nullptr;
  }
  const Interval signedRange = this->distance().signedRange(local);
  if (signedRange.min >= influenceRadius_)
  {
    return nullptr;
  }
  if (signedRange.max <= -offset_)
  {
    return std::make_shared<DeepInside>(potential_.maximumField());
  }
  const double farthest = std::max(-signedRange.min, signedRange.max);
  return std::make_shared<Part>(*this, box, local, this->fieldRange(signedRange),
    std::min(farthest, std::max(influenceRadius_, offset_)));
}

void MeshField::membership(PointBatch points, std::int8_t* side) const
{
  if (this->isNegative())
  {
    std::fill_n(side, points.size, std::int8_t(-1));
    return;
  }
  if (identity_)
  {
    this->distance().side(points, side);
    return;
  }
  ScratchVectors mapped(points.size);
  toMesh(inverse_, points, mapped.batch());
  this->distance().side(mapped.points(), side);
}

void MeshField::signedDistance(PointBatch points, double* distance) const
{
  const std::optional<double> scale = similarityScale(map_);
  if (!scale || this->isNegative())
  {
    std::fill_n(distance, points.size, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  ScratchVectors mapped(points.size);
  toMesh(inverse_, points, mapped.batch());
  this->distance().signedDistance(
    mapped.points(), std::numeric_limits<double>::infinity(), distance, {});
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] *= *scale;
  }
}

void MeshField::nearestTriangle(
  PointBatch points, double* distance, std::int32_t* triangle, VectorBatch nearestPoint) const
{
  ScratchVectors mapped(points.size);
  toMesh(inverse_, points, mapped.batch());
  this->distance().nearest(mapped.points(), influenceRadius_, distance, triangle, nearestPoint);
  for (std::size_t k = 0; k < points.size && !identity_; ++k)
  {
    nearestPoint.set(k, map_ * nearestPoint[k]);
  }
}

} // namespace hybridtree
