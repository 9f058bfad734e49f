// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/WindingNumber.h"

#include "core/mesh/SolidAngle.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Radii away from which a cluster counts as a dipole: error about 1 / kFar^3 of its solid angle.
constexpr double kFar = 3.0;

} // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, const MeshBvh& bvh)
  : mesh_(mesh), bvh_(bvh), children_(bvh.nodes().size() * MeshBvh::kWidth)
{
  this->gather(0);
}

WindingNumber::Dipole WindingNumber::gather(std::uint32_t ref)
{
  Dipole whole;
  if (ref & MeshBvh::kLeafBit)
  {
    const MeshBvh::Leaf& leaf = bvh_.leaves()[ref & ~MeshBvh::kLeafBit];
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      const std::size_t t = std::size_t(leaf.triangle[k]);
      const Vec3 normal = 0.5 * areaNormal(mesh_, t);
      const double area = normal.norm();
      Vec3 middle = Vec3::Zero();
      for (const std::int32_t vertex : mesh_.triangles[t])
      {
        middle += mesh_.points[std::size_t(vertex)] / 3.0;
        whole.box.extend(mesh_.points[std::size_t(vertex)]);
      }
      whole.center += area * middle;
      whole.normal += normal;
      whole.area += area;
    }
  }
  else
  {
    for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
    {
      const std::uint32_t child = bvh_.nodes()[ref].child[k];
      if (child == MeshBvh::kNone)
      {
        break;
      }
      const Dipole part = this->gather(child);
      children_[ref * MeshBvh::kWidth + k] = part;
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
  AngleSum angles;
  const double far = this->sum(0, p, angles);
  return (far + 2.0 * angles.sum()) / kFullSolidAngle;
}

double WindingNumber::sum(std::uint32_t node, const Vec3& p, AngleSum& angles) const
{
  double total = 0.0;
  for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
  {
    const std::uint32_t child = bvh_.nodes()[node].child[k];
    if (child == MeshBvh::kNone)
    {
      break;
    }
    const Dipole& dipole = children_[node * MeshBvh::kWidth + k];
    const Vec3 toward = dipole.center - p;
    const double squared = toward.squaredNorm();
    const double far = kFar * dipole.radius;
    if (squared > far * far)
    {
      total += dipole.normal.dot(toward) / (squared * std::sqrt(squared));
    }
    else if (child & MeshBvh::kLeafBit)
    {
      const MeshBvh::Leaf& leaf = bvh_.leaves()[child & ~MeshBvh::kLeafBit];
      for (std::size_t j = 0; j < leaf.count; ++j)
      {
        const Triangle& c = mesh_.triangles[std::size_t(leaf.triangle[j])];
        const auto [sine, cosine] = halfSolidAngle(mesh_.points[std::size_t(c[0])],
          mesh_.points[std::size_t(c[1])], mesh_.points[std::size_t(c[2])], p);
        angles.add(sine, cosine);
      }
    }
    else
    {
      total += this->sum(child, p, angles);
    }
  }
  return total;
}

} // namespace hybridtree
