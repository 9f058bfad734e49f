// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePolygon.h"

#include "core/skeletons/Polygon.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreePolygon);

//------------------------------------------------------------------------------
vtkHybridTreePolygon::vtkHybridTreePolygon()
{
  this->Points = { { -0.5, -0.5, 0.0 }, { 0.5, -0.5, 0.0 }, { 0.5, 0.0, 0.0 }, { 0.0, 0.0, 0.0 },
    { 0.0, 0.5, 0.0 }, { -0.5, 0.5, 0.0 } };
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreePolygon::~vtkHybridTreePolygon() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreePolygon::MakeSkeleton()
{
  std::vector<hybridtree::Vec3> points;
  for (const std::array<double, 3>& point : this->Points)
  {
    points.emplace_back(point.data());
  }
  return hybridtree::makePolygon(std::move(points), this->LevelOfDetail);
}

//------------------------------------------------------------------------------
void vtkHybridTreePolygon::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
}
