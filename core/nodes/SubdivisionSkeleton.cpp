// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeleton.h"

#include "core/base/Error.h"
#include "core/geometry/IntervalMath.h"
#include "core/nodes/EnumNames.h"
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

constexpr EnumNames<SubdivisionScheme, 2> kSchemes{ "Scheme", "scheme",
  { "approximating", "interpolating" } };
constexpr EnumNames<KernelKind, 2> kKernels{ "Kernel", "kernel", { "compact", "cauchy" } };
constexpr EnumNames<BlendingKind, 3> kBlendings{ "Blending", "blending",
  { "all", "neighbours", "paper" } };
constexpr EnumNames<SkeletonRadius, 2> kRadii{ "Radius", "radius", { "linear", "constant" } };

// The kernels' reaches at the corners of one element.
template <std::size_t N>
std::array<double, N> reachesOf(const RefinedSkeleton& skeleton,
  const std::array<std::int32_t, N>& corners, const SubdivisionSkeletonOptions& options)
{
  std::array<double, N> reaches;
  for (std::size_t k = 0; k < N; ++k)
  {
    reaches[k] =
      options.kernel.influenceRatio * skeleton.radii[static_cast<std::size_t>(corners[k])];
  }
  if (options.radius == SkeletonRadius::Constant)
  {
    reaches.fill(std::accumulate(reaches.begin(), reaches.end(), 0.0) / N);
  }
  return reaches;
}

// Weights of the parent's corners.
std::array<double, 3> weightsAt(double u)
{
  return { 1.0 - u, u, 0.0 };
}

std::array<double, 3> weightsAt(const Eigen::Vector2d& place)
{
  return { 1.0 - place[0] - place[1], place[0], place[1] };
}

template <std::size_t N, typename Places>
GroupedElement<N> child(const RefinedSkeleton& skeleton, const std::array<std::int32_t, N>& corners,
  const Places& places, std::size_t group, const SubdivisionSkeletonOptions& options)
{
  GroupedElement<N> element{ corners, reachesOf(skeleton, corners, options), {},
    static_cast<std::int32_t>(group) };
  for (std::size_t k = 0; k < N; ++k)
  {
    element.weights[k] = weightsAt(places[k]);
  }
  return element;
}

// The children of one coarse element are a group: coarse segments first.
GroupedElements groupedElements(const SkeletonGraph& coarse, const RefinedSkeleton& skeleton,
  const SubdivisionSkeletonOptions& options)
{
  GroupedElements elements;
  elements.points = skeleton.points;
  for (const double radius : skeleton.radii)
  {
    elements.reaches.push_back(options.kernel.influenceRatio * radius);
  }
  for (std::size_t k = 0; k < skeleton.segments.size(); ++k)
  {
    elements.segments.push_back(child(skeleton, skeleton.segments[k], skeleton.segmentParameters[k],
      static_cast<std::size_t>(skeleton.segmentParents[k]), options));
  }
  for (std::size_t k = 0; k < skeleton.triangles.size(); ++k)
  {
    elements.triangles.push_back(
      child(skeleton, skeleton.triangles[k], skeleton.triangleParameters[k],
        coarse.segments.size() + static_cast<std::size_t>(skeleton.triangleParents[k]), options));
  }
  for (const SkeletonSegment& ends : coarse.segments)
  {
    elements.groups.push_back({ ends[0], ends[1], -1 });
  }
  elements.groups.insert(elements.groups.end(), coarse.triangles.begin(), coarse.triangles.end());
  return elements;
}

SubdivisionSkeleton::ShapePtr makeShape(
  const SkeletonGraph& graph, const SubdivisionSkeletonOptions& options)
{
  validate(options.kernel);
  validate(options.blending);
  kBlendings.check(options.blending.kind);
  kSchemes.check(options.scheme);
  kKernels.check(options.kernel.kind);
  kRadii.check(options.radius);
  if (!(options.refinement > 0.0 && options.refinement <= 1.0))
  {
    throw InvalidParameter("Refinement", options.refinement, "above 0 and at most 1");
  }
  RefinedSkeleton refined = subdivide(graph, options.scheme, options.level);
  BlendedField field(options.kernel, options.blending, groupedElements(graph, refined, options));
  return std::make_shared<SubdivisionSkeleton::Shape>(SubdivisionSkeleton::Shape{
    graph, options, std::move(refined), std::move(field), numberPieces(graph) });
}

template <std::size_t N>
std::vector<std::int64_t> flat(const std::vector<std::array<std::int32_t, N>>& elements)
{
  std::vector<std::int64_t> indices;
  for (const std::array<std::int32_t, N>& element : elements)
  {
    indices.insert(indices.end(), element.begin(), element.end());
  }
  return indices;
}

// The inverse of flat().
template <std::size_t N, typename Number>
std::vector<std::array<Number, N>> grouped(const std::vector<Number>& numbers, const char* name)
{
  if (numbers.size() % N != 0)
  {
    throw InvalidText("Parameter \"" + std::string(name) + "\" has " +
      std::to_string(numbers.size()) + " numbers; it must have a multiple of " + std::to_string(N) +
      ".");
  }
  std::vector<std::array<Number, N>> groups(numbers.size() / N);
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    groups[k / N][k % N] = numbers[k];
  }
  return groups;
}

template <std::size_t N>
std::vector<std::array<std::int32_t, N>> indices(const Parameters& parameters, const char* name)
{
  std::vector<std::array<std::int32_t, N>> elements;
  for (const std::array<std::int64_t, N>& group : grouped<N>(parameters.getInts(name), name))
  {
    std::array<std::int32_t, N>& element = elements.emplace_back();
    // What does not fit is no index of a point either.
    std::transform(group.begin(), group.end(), element.begin(),
      [](std::int64_t index)
      { return static_cast<std::int32_t>(std::clamp<std::int64_t>(index, -1, INT32_MAX)); });
  }
  return elements;
}

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
  static thread_local BlendSelection selection; // no allocation once warm
  this->convolution().select(this->toOwnSpace(box), selection);
  return this->rangeOf(selection, box);
}

FieldSourcePtr SubdivisionSkeleton::restrictedTo(const Box3& box) const
{
  BlendSelection selection;
  this->convolution().select(this->toOwnSpace(box), selection);
  return selection.empty() ? nullptr : std::make_shared<Restriction>(*this, std::move(selection));
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

Parameters SubdivisionSkeleton::parameters() const
{
  const SubdivisionSkeletonOptions& options = this->options();
  Parameters parameters;
  std::vector<double> points;
  for (const Vec3& point : this->coarse().points)
  {
    points.insert(points.end(), point.data(), point.data() + 3);
  }
  parameters.set("points", Parameters::Value(std::move(points)));
  parameters.set("radii", Parameters::Value(this->coarse().radii));
  parameters.set("segments", Parameters::Value(flat(this->coarse().segments)));
  parameters.set("triangles", Parameters::Value(flat(this->coarse().triangles)));
  kSchemes.describe(options.scheme, parameters);
  parameters.set("level", options.level);
  kKernels.describe(options.kernel.kind, parameters);
  parameters.set("exponent", options.kernel.exponent);
  parameters.set("influenceRatio", options.kernel.influenceRatio);
  kRadii.describe(options.radius, parameters);
  kBlendings.describe(options.blending.kind, parameters);
  parameters.set("blendDistance", options.blending.distance);
  parameters.set("refinement", options.refinement);
  parameters.set("negative", options.negative);
  if (placement_)
  {
    parameters.set("map", placement_->map);
  }
  return parameters;
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
    return std::make_shared<SubdivisionSkeleton>(makeShape(graph, options), map);
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
  return std::make_shared<SubdivisionSkeleton>(makeShape(image, options), Affine3::Identity());
}

NodePtr subdivisionSkeletonFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("subdivisionSkeleton", children, 0);
  SkeletonGraph graph;
  for (const std::array<double, 3>& point : grouped<3>(parameters.getDoubles("points"), "points"))
  {
    graph.points.emplace_back(point[0], point[1], point[2]);
  }
  graph.radii = parameters.getDoubles("radii");
  graph.segments = indices<2>(parameters, "segments");
  graph.triangles = indices<3>(parameters, "triangles");
  SubdivisionSkeletonOptions options;
  options.scheme = kSchemes.from(parameters);
  options.level = parameters.getInt("level");
  options.kernel.kind = kKernels.from(parameters);
  options.kernel.exponent = parameters.getInt("exponent");
  options.kernel.influenceRatio = parameters.getDouble("influenceRatio");
  options.radius = kRadii.from(parameters);
  options.blending.kind = kBlendings.from(parameters);
  options.blending.distance = parameters.getDouble("blendDistance");
  options.refinement = parameters.getDouble("refinement");
  options.negative = parameters.getBool("negative");
  const Affine3 map =
    parameters.has("map") ? parameters.getAffine("map") : Affine3(Affine3::Identity());
  return makeSubdivisionSkeleton(graph, options, map);
}

} // namespace hybridtree
