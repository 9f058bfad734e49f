// SPDX-License-Identifier: BSD-3-Clause
// One shape twice, from the core and from the VTK filter: the volume of a ball of radius 1.
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include <vtkHybridTreePoint.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cmath>
#include <iostream>
#include <memory>

namespace
{

constexpr double kBallVolume = 4.18879;

double volume(const hybridtree::TriangleMesh& mesh)
{
  double six = 0.0;
  for (const hybridtree::Triangle& t : mesh.triangles)
  {
    six += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]]));
  }
  return six / 6.0;
}

} // namespace

int main()
{
  const auto skeleton = std::make_shared<hybridtree::PointSkeleton>(hybridtree::Vec3::Zero());
  const auto potential = hybridtree::Potential::bySurfaceRadius(1.0, 2.0, 2);
  const double fromCore = volume(*hybridtree::makePrimitive(skeleton, potential)->mesh());

  vtkNew<vtkHybridTreePoint> point;
  point->SetSurfaceRadius(1.0);
  point->SetInfluenceRadius(2.0);
  point->Update();
  const vtkIdType triangles = point->GetOutput()->GetNumberOfCells();

  std::cout << "volume " << fromCore << ", " << triangles << " triangles\n";
  return std::abs(fromCore - kBallVolume) < 0.01 * kBallVolume && triangles > 100 ? 0 : 1;
}
