// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeletonMesh.h"

#include "core/nodes/LatticeMesh.h"
#include "core/subdivision/SkeletonMesh.h"

#include <functional>

namespace hybridtree
{
namespace
{

PieceMeshCache& sharedCache()
{
  static PieceMeshCache cache;
  return cache;
}

void mix(std::uint64_t& key, std::uint64_t word)
{
  key = (key ^ word) * 0x9e3779b97f4a7c15ull;
  key ^= key >> 31;
}

/// All that is told of the leaf but its elements.
std::uint64_t optionsKey(const Parameters& parameters)
{
  std::uint64_t key = 0;
  for (const auto& [name, value] : parameters.entries())
  {
    mix(key, std::hash<std::string>()(name));
    if (const auto* text = std::get_if<std::string>(&value))
    {
      mix(key, std::hash<std::string>()(*text));
    }
    else if (const auto* real = std::get_if<double>(&value))
    {
      mix(key, std::hash<double>()(*real));
    }
    else if (const auto* integer = std::get_if<std::int64_t>(&value))
    {
      mix(key, std::uint64_t(*integer));
    }
    else if (const auto* flag = std::get_if<bool>(&value))
    {
      mix(key, *flag ? 1 : 2);
    }
  }
  return key;
}

/// How far from an element, in radii, a change of it may be felt.
double reachOf(const SubdivisionSkeletonOptions& options, const Parameters& parameters)
{
  // Where not everything blends, what does is told by ways along the graph, up to twice the reach.
  const bool controlled = parameters.has("blending") && parameters.getString("blending") != "all";
  // The other kernel goes on until it is next to nothing.
  const double support = options.kernel.kind == KernelKind::Compact ? 1.0 : 8.0;
  return options.kernel.influenceRatio * (controlled ? 3.0 : 1.0) * support;
}

SkeletonField fieldOf(const SubdivisionSkeleton& leaf)
{
  const SubdivisionSkeletonOptions& options = leaf.options();
  const Parameters parameters = leaf.parameters();
  return { leaf.coarse(), leaf.refined(), options.level, leaf, reachOf(options, parameters),
    optionsKey(parameters) };
}

/// To the space of the node, of which the leaf is the shape in its own.
void applyMap(const Affine3& map, TriangleMesh& mesh)
{
  for (Vec3& point : mesh.points)
  {
    point = map * point;
  }
  const Mat3 turned = map.linear().inverse().transpose();
  for (Vec3& normal : mesh.normals)
  {
    normal = (turned * normal).normalized();
  }
  if (map.linear().determinant() < 0.0)
  {
    for (Triangle& triangle : mesh.triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
}

} // namespace

TriangleMesh subdivisionSkeletonMesh(const SubdivisionSkeleton& leaf, double edgeLength,
  std::string& warning, const Progress& progress)
{
  if (leaf.isNegative() || leaf.map())
  {
    return latticeMesh(leaf, edgeLength, progress);
  }
  SkeletonMeshOptions options;
  options.edgeLength = edgeLength;
  options.refinement = leaf.options().refinement;
  std::optional<StitchedMesh> made =
    skeletonMesh(fieldOf(leaf), options, &sharedCache(), ProgressPart(progress, 0.0, 0.8));
  if (!made)
  {
    warning = "The meshes of the skeleton's pieces could not be joined; all of it was polygonized. "
              "A shorter edge length may help.";
    return latticeMesh(leaf, edgeLength, ProgressPart(progress, 0.8, 1.0));
  }
  made->mesh.sourceLeaf.assign(made->mesh.triangles.size(), 0);
  return std::move(made->mesh);
}

TriangleMesh subdivisionSkeletonPreview(const SubdivisionSkeleton& leaf, const Progress& progress)
{
  if (leaf.isNegative())
  {
    return {};
  }
  if (const std::optional<Affine3> map = leaf.map())
  {
    const NodePtr own = makeSubdivisionSkeleton(leaf.coarse(), leaf.options());
    TriangleMesh mesh =
      subdivisionSkeletonPreview(static_cast<const SubdivisionSkeleton&>(*own), progress);
    applyMap(*map, mesh);
    return mesh;
  }
  PieceMeshOptions options;
  options.refinement = leaf.options().refinement;
  return joinPieces(pieceMeshes(fieldOf(leaf), options, &sharedCache(), progress));
}

} // namespace hybridtree
