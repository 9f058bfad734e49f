// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshBvh.h"
#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

class AngleSum;

/// Generalised winding number of any triangle mesh: solid angle of its front seen from p, in turns.
/// 1 inside and 0 outside a closed mesh, in between near the holes of an open one; inside is above
/// 1/2 (Jacobson et al. 2013). Clusters far from p count as dipoles (Barill et al. 2018).
class WindingNumber
{
public:
  /// \pre mesh and bvh outlive this.
  WindingNumber(const TriangleMesh& mesh, const MeshBvh& bvh);

  double at(const Vec3& p) const;

private:
  struct Dipole
  {
    Vec3 center = Vec3::Zero(); // mean of the triangles, by area
    Vec3 normal = Vec3::Zero(); // sum of area normals
    double area = 0.0;
    double radius = 0.0; // of a ball around center that holds all
    Box3 box;
  };

  Dipole gather(std::uint32_t ref);
  /// \returns the solid angle of the clusters far from p; half of that of each other triangle is
  /// added to angles.
  double sum(std::uint32_t node, const Vec3& p, AngleSum& angles) const;

  const TriangleMesh& mesh_;
  const MeshBvh& bvh_;
  std::vector<Dipole> children_; // kWidth per node
};

} // namespace hybridtree
