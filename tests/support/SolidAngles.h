// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/SolidAngle.h"
#include "core/mesh/TriangleMesh.h"

namespace hybridtree::test
{

/// The winding number of a mesh at p, triangle by triangle.
inline double sumOfSolidAngles(const TriangleMesh& mesh, const Vec3& p)
{
  double angle = 0.0;
  for (const Triangle& c : mesh.triangles)
  {
    angle += solidAngle(mesh.points[std::size_t(c[0])], mesh.points[std::size_t(c[1])],
      mesh.points[std::size_t(c[2])], p);
  }
  return angle / kFullSolidAngle;
}

} // namespace hybridtree::test
