// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/MeshQuality.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>

#include <algorithm>
#include <cmath>

namespace benchmarks
{

using namespace hybridtree;

MeshQuality qualityOf(
  const TriangleMesh& mesh, const std::function<double(const double*)>& distance)
{
  MeshQuality quality;
  quality.triangles = mesh.triangles.size();
  for (const Triangle& t : mesh.triangles)
  {
    double lengths[3];
    double least = EIGEN_PI;
    double area = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 u = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
      const Vec3 v = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      area = 0.5 * u.cross(v).norm();
      least = std::min(least, std::atan2(2.0 * area, u.dot(v)));
      lengths[k] = u.norm();
    }
    const double inradius = 2.0 * area / (lengths[0] + lengths[1] + lengths[2]);
    quality.meanLeast += least * 180.0 / EIGEN_PI;
    quality.below25 += least < 25.0 * EIGEN_PI / 180.0;
    // Slivers of no area at all, of which marching cubes has some, would make the mean infinite.
    quality.aspectRatio +=
      std::min(1e3, *std::max_element(lengths, lengths + 3) / (2.0 * std::sqrt(3.0) * inradius));
    const Vec3 center = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    const double off = distance(center.data());
    quality.error += off * off;
  }
  const double count = double(mesh.triangles.size());
  quality.meanLeast /= count;
  quality.below25 /= count;
  quality.aspectRatio /= count;
  quality.error = std::sqrt(quality.error / count);
  return quality;
}

TriangleMesh trianglesOf(vtkPolyData* data)
{
  TriangleMesh mesh;
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    mesh.points.emplace_back(data->GetPoint(k));
  }
  vtkNew<vtkIdList> ids;
  vtkCellArray* polygons = data->GetPolys();
  for (vtkIdType k = 0; k < polygons->GetNumberOfCells(); ++k)
  {
    polygons->GetCellAtId(k, ids);
    mesh.triangles.push_back({ static_cast<std::int32_t>(ids->GetId(0)),
      static_cast<std::int32_t>(ids->GetId(1)), static_cast<std::int32_t>(ids->GetId(2)) });
  }
  return mesh;
}

} // namespace benchmarks
