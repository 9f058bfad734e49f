// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MappedMesh.h"

#include <Eigen/SVD>

#include <utility>

namespace hybridtree
{

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

double middleStretch(const Affine3& map)
{
  return Eigen::JacobiSVD<Mat3>(map.linear()).singularValues()[1];
}

} // namespace hybridtree
