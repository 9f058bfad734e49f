// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/PeerDistances.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <memory>
#include <vector>

namespace hybridtree::benchmark
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<
  CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

struct CgalMesh
{
  Triangles triangles;
  Tree tree;
};

} // namespace

PeerDistance cgalDistance(const TriangleMesh& mesh)
{
  const auto peer = std::make_shared<CgalMesh>();
  const auto at = [&](std::int32_t vertex)
  {
    const Vec3& p = mesh.points[std::size_t(vertex)];
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  for (const Triangle& c : mesh.triangles)
  {
    peer->triangles.emplace_back(at(c[0]), at(c[1]), at(c[2]));
  }
  peer->tree.insert(peer->triangles.cbegin(), peer->triangles.cend());
  peer->tree.build();
  peer->tree.accelerate_distance_queries();
  return [peer](PointBatch points, double* distance)
  {
    for (std::size_t k = 0; k < points.size; ++k)
    {
      distance[k] =
        std::sqrt(peer->tree.squared_distance({ points.x[k], points.y[k], points.z[k] }));
    }
  };
}

PeerDistance vtkDistance(const TriangleMesh& mesh)
{
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points)
  {
    vertices->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& c : mesh.triangles)
  {
    const vtkIdType corner[3] = { c[0], c[1], c[2] };
    cells->InsertNextCell(3, corner);
  }
  vtkNew<vtkPolyData> polyData;
  polyData->SetPoints(vertices);
  polyData->SetPolys(cells);
  const auto peer = vtkSmartPointer<vtkImplicitPolyDataDistance>::New();
  peer->SetInput(polyData);
  return [peer](PointBatch points, double* distance)
  {
    for (std::size_t k = 0; k < points.size; ++k)
    {
      distance[k] = peer->EvaluateFunction(points.x[k], points.y[k], points.z[k]);
    }
  };
}

} // namespace hybridtree::benchmark
