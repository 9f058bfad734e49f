// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshBvh.h"
#include "core/mesh/TriangleMesh.h"
#include "core/mesh/WindingKernels.h"

#include <vector>

namespace hybridtree
{

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
  struct Cluster
  {
    Vec3 center = Vec3::Zero(); // mean of the triangles, by area
    Vec3 normal = Vec3::Zero(); // sum of area normals
    double area = 0.0;
    double radius = 0.0; // of a ball around center that holds all
    Box3 box;
  };

  Cluster gather(std::uint32_t ref);

  WindingTree tree_;
};

} // namespace hybridtree
