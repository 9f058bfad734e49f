// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeleton.h"

#include "core/base/Error.h"
#include "core/geometry/IntervalMath.h"
#include "core/nodes/LocalPoints.h"
#include "core/nodes/Membership.h"
#include "core/nodes/SubdivisionSkeletonMesh.h"
#include "core/polygonize/LevelBounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

void clear(std::size_t count, double* value)
{
  std::fill_n(value, count, 0.0);
}

void clear(std::size_t count, double* value, VectorBatch gradient)
{
  clear(count, value);
  clear(count, gradient.x);
  clear(count, gradient.y);
  clear(count, gradient.z);
}

} // namespace

struct SubdivisionSkeleton::Placement
{
  Affine3 map; // from the space of the skeleton to that of the node
  Affine3 inverse;
};

// The leaf with only those elements that reach a box.
class SubdivisionSkeleton::Restriction final : public FieldSource
{
public:
  Restriction(const SubdivisionSkeleton& leaf, BlendSelection selection)
    : leaf_(leaf), selection_(std::move(selection))
  {
  }

  void field(PointBatch points, double* value) const override
  {
    clear(points.size, value);
    this->addField(points, value);
  }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    clear(points.size, value, gradient);
    this->addFieldAndGradient(points, value, gradient);
  }
  void addField(PointBatch points, double* sum) const override
  {
    leaf_.addSelected(&selection_, points, sum);
  }
  void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const override
  {
    leaf_.addSelected(&selection_, points, sum, gradientSum);
  }
  Interval range(const Box3& box) const override { return leaf_.rangeOf(selection_, box); }
  FieldSourcePtr restrictedTo(const Box3& box) const override { return leaf_.restrictedTo(box); }

private:
  const SubdivisionSkeleton& leaf_;
  BlendSelection selection_;
};

SubdivisionSkeleton::SubdivisionSkeleton(ShapePtr shape, const Affine3& map)
  : shape_(std::move(shape))
{
  if (map.matrix() != Affine3::Identity().matrix())
  {
    placement_.reset(new Placement{ map, map.inverse() });
  }
}

SubdivisionSkeleton::~SubdivisionSkeleton() = default;

std::optional<Affine3> SubdivisionSkeleton::map() const
{
  return placement_ ? std::optional<Affine3>(placement_->map) : std::nullopt;
}

Box3 SubdivisionSkeleton::toOwnSpace(const Box3& box) const
{
  return placement_ ? transformed(box, placement_->inverse) : box;
}

SubdivisionSkeleton::Reaching SubdivisionSkeleton::elementsReaching(const Box3& box) const
{
  ElementSelection selection;
  const ConvolutionField& convolution = this->convolution().sum();
  convolution.select(this->toOwnSpace(box), selection);
  Reaching reaching;
  for (const SegmentElement* segment : selection.segments)
  {
    reaching.segments.push_back(convolution.index(segment));
  }
  for (const TriangleElement* triangle : selection.triangles)
  {
    reaching.triangles.push_back(convolution.index(triangle));
  }
  std::sort(reaching.segments.begin(), reaching.segments.end());
  std::sort(reaching.triangles.begin(), reaching.triangles.end());
  return reaching;
}

void SubdivisionSkeleton::addSelected(
  const BlendSelection* selection, PointBatch points, double* sum) const
{
  if (!placement_ && !this->isNegative())
  {
    this->convolution().addField(selection, points, sum);
    return;
  }
  const LocalPoints local(points, placement_ ? &placement_->inverse : nullptr);
  ScratchArray value(points.size);
  clear(points.size, value.data());
  this->convolution().addField(selection, local, value.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += this->sign() * value[k];
  }
}

void SubdivisionSkeleton::addSelected(
  const BlendSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const
{
  if (!placement_ && !this->isNegative())
  {
    this->convolution().addFieldAndGradient(selection, points, sum, gradientSum);
    return;
  }
  const LocalPoints local(points, placement_ ? &placement_->inverse : nullptr);
  ScratchArray value(points.size);
  ScratchVectors own(points.size);
  const VectorBatch gradient = own.batch();
  clear(points.size, value.data(), gradient);
  this->convolution().addFieldAndGradient(selection, local, value.data(), gradient);
  const Mat3 turned = this->sign() *
    (placement_ ? Mat3(placement_->inverse.linear().transpose()) : Mat3(Mat3::Identity()));
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += this->sign() * value[k];
    gradientSum.set(k, gradientSum[k] + turned * gradient[k]);
  }
}

void SubdivisionSkeleton::field(PointBatch points, double* value) const
{
  clear(points.size, value);
  this->addField(points, value);
}

void SubdivisionSkeleton::fieldAndGradient(
  PointBatch points, double* value, VectorBatch gradient) const
{
  clear(points.size, value, gradient);
  this->addFieldAndGradient(points, value, gradient);
}

void SubdivisionSkeleton::addField(PointBatch points, double* sum) const
{
  this->addSelected(nullptr, points, sum);
}

void SubdivisionSkeleton::addFieldAndGradient(
  PointBatch points, double* sum, VectorBatch gradientSum) const
{
  this->addSelected(nullptr, points, sum, gradientSum);
}

Interval SubdivisionSkeleton::rangeOf(const BlendSelection& selection, const Box3& box) const
{
  const Interval range = this->convolution().range(selection, this->toOwnSpace(box));
  return this->isNegative() ? -range : range;
}

Interval SubdivisionSkeleton::range(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return { 0.0, 0.0 };
  }
  static thread_local BlendSelection selection; // no allocation once warm
  this->convolution().select(this->toOwnSpace(box), selection);
  return this->rangeOf(selection, box);
}

FieldSourcePtr SubdivisionSkeleton::restrictedTo(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return nullptr;
  }
  // Copied where it is kept: lists that grow anew would be allocated several times.
  static thread_local BlendSelection selection;
  this->convolution().select(this->toOwnSpace(box), selection);
  return selection.empty() ? nullptr : std::make_shared<Restriction>(*this, selection);
}

void SubdivisionSkeleton::membership(PointBatch points, std::int8_t* side) const
{
  ScratchArray value(points.size);
  this->field(points, value.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    side[k] = sideOf(value[k]);
  }
}

void SubdivisionSkeleton::sourceLeaf(PointBatch points, std::int32_t* leaf) const
{
  nearestPieces(*this, points, leaf);
  ScratchArray value(points.size);
  this->field(points, value.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    leaf[k] = value[k] != 0.0 ? std::max(leaf[k], 0) : -1;
  }
}

Box3 SubdivisionSkeleton::influenceBounds() const
{
  const Box3 box = this->convolution().influenceBounds();
  return placement_ ? transformed(box, placement_->map) : box;
}

Box3 SubdivisionSkeleton::surfaceBounds() const
{
  std::call_once(surfaceBoundsOnce_,
    [this]
    {
      const Box3 reach = this->influenceBounds();
      surfaceBounds_ = this->isNegative()
        ? Box3()
        : levelBounds(*this, kThreshold, reach, 0.01 * reach.sizes().maxCoeff());
    });
  return surfaceBounds_;
}

std::optional<SurfaceField> SubdivisionSkeleton::surfaceField() const
{
  if (this->isNegative())
  {
    return std::nullopt;
  }
  // As far outside and as high as a straight curve of the mean radius.
  const ConvolutionKernel& kernel = this->options().kernel;
  const std::vector<double>& radii = this->refined().radii;
  const double radius =
    std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  const double scale =
    placement_ ? std::cbrt(std::abs(placement_->map.linear().determinant())) : 1.0;
  const double rest = 1.0 - 1.0 / (kernel.influenceRatio * kernel.influenceRatio);
  return SurfaceField{ kThreshold / std::pow(rest, kernel.exponent + 0.5),
    scale * (kernel.influenceRatio - 1.0) * radius, kernel.exponent };
}

TriangleMesh SubdivisionSkeleton::makeMesh(double edgeLength, const Progress& progress) const
{
  std::string warning;
  TriangleMesh mesh = subdivisionSkeletonMesh(*this, edgeLength, warning, progress);
  warnings_.add(warning);
  return mesh;
}

NodePtr SubdivisionSkeleton::makeAffine(const Affine3& map) const
{
  const Affine3 whole = placement_ ? map * placement_->map : map;
  if (similarityScale(whole))
  {
    return makeSubdivisionSkeleton(this->coarse(), this->options(), whole);
  }
  return std::make_shared<SubdivisionSkeleton>(shape_, whole);
}

NodePtr makeSubdivisionSkeleton(
  const SkeletonGraph& graph, const SubdivisionSkeletonOptions& options, const Affine3& map)
{
  if (!map.matrix().allFinite() || map.linear().determinant() == 0.0)
  {
    throw InvalidParameter(
      "The map of a skeleton", "not finite or not invertible", "an invertible matrix");
  }
  const std::optional<double> scale = similarityScale(map);
  if (!scale || map.matrix() == Affine3::Identity().matrix())
  {
    return std::make_shared<SubdivisionSkeleton>(
      SubdivisionSkeleton::makeShape(graph, options), map);
  }
  SkeletonGraph image = graph;
  for (Vec3& point : image.points)
  {
    point = map * point;
  }
  for (double& radius : image.radii)
  {
    radius *= *scale;
  }
  return std::make_shared<SubdivisionSkeleton>(
    SubdivisionSkeleton::makeShape(image, options), Affine3::Identity());
}

} // namespace hybridtree
