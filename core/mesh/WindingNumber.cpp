// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/WindingNumber.h"

#include "core/mesh/SolidAngle.h"

#include <limits>

namespace hybridtree
{
namespace
{

// Radii away from which a cluster counts as a dipole: error about 1 / kFar^3 of its solid angle.
constexpr double kFar = 3.0;
constexpr std::size_t kMostKept = 100'000; // triangles whose corners are kept by leaf: 10 MB
constexpr double kNever = std::numeric_limits<double>::infinity();

} // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, const MeshBvh& bvh)
  : tree_{ &mesh, &bvh, std::vector<WindingDipoles>(bvh.nodes().size()), {} }
{
  this->gather(0);
  if (mesh.triangles.size() <= kMostKept)
  {
    tree_.corners.reserve(bvh.leaves().size());
    for (const MeshBvh::Leaf& leaf : bvh.leaves())
    {
      tree_.corners.push_back(LeafCorners::of(mesh, leaf));
    }
  }
}

WindingNumber::Cluster WindingNumber::gather(std::uint32_t ref)
{
  Cluster whole;
  if (ref & MeshBvh::kLeafBit)
  {
    const MeshBvh::Leaf& leaf = tree_.bvh->leaves()[ref & ~MeshBvh::kLeafBit];
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      const std::size_t t = std::size_t(leaf.triangle[k]);
      const Vec3 normal = 0.5 * areaNormal(*tree_.mesh, t);
      const double area = normal.norm();
      Vec3 middle = Vec3::Zero();
      for (const std::int32_t vertex : tree_.mesh->triangles[t])
      {
        middle += tree_.mesh->points[std::size_t(vertex)] / 3.0;
        whole.box.extend(tree_.mesh->points[std::size_t(vertex)]);
      }
      whole.center += area * middle;
      whole.normal += normal;
      whole.area += area;
    }
  }
  else
  {
    WindingDipoles& dipoles = tree_.dipoles[ref];
    for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
    {
      const std::uint32_t child = tree_.bvh->nodes()[ref].child[k];
      const Cluster part = child == MeshBvh::kNone ? Cluster() : this->gather(child);
      for (int axis = 0; axis < 3; ++axis)
      {
        dipoles.center[axis][k] = part.center[axis];
        dipoles.normal[axis][k] = part.normal[axis];
      }
      const double far = kFar * part.radius;
      dipoles.squaredFar[k] = child == MeshBvh::kNone ? kNever : far * far;
      whole.center += part.area * part.center;
      whole.normal += part.normal;
      whole.area += part.area;
      whole.box.extend(part.box);
    }
  }
  whole.center = whole.area > 0.0 ? Vec3(whole.center / whole.area) : whole.box.center();
  const Vec3 reach = (whole.box.max() - whole.center).cwiseMax(whole.center - whole.box.min());
  whole.radius = reach.norm();
  return whole;
}

double WindingNumber::at(const Vec3& p) const
{
  return solidAngleOfMesh(tree_, p) / kFullSolidAngle;
}

} // namespace hybridtree
