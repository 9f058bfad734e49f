// SPDX-License-Identifier: BSD-3-Clause
// A skeleton leaf as parameters, and back.
#include "core/nodes/SubdivisionSkeletonText.h"

#include "core/base/Error.h"
#include "core/nodes/EnumNames.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr EnumNames<SubdivisionScheme, 2> kSchemes{ "Scheme", "scheme",
  { "approximating", "interpolating" } };
constexpr EnumNames<KernelKind, 2> kKernels{ "Kernel", "kernel", { "compact", "cauchy" } };
constexpr EnumNames<BlendingKind, 3> kBlendings{ "Blending", "blending",
  { "all", "neighbours", "paper" } };
constexpr EnumNames<SkeletonRadius, 2> kRadii{ "RadiusInterpolation", "radius", { "linear", "constant" } };

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

} // namespace

void checkNames(const SubdivisionSkeletonOptions& options)
{
  kBlendings.check(options.blending.kind);
  kSchemes.check(options.scheme);
  kKernels.check(options.kernel.kind);
  kRadii.check(options.radius);
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
  if (const std::optional<Affine3> map = this->map())
  {
    parameters.set("map", *map);
  }
  return parameters;
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
