// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePolygon.h"

#include "core/skeletons/Polygon.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreePolygon);

//------------------------------------------------------------------------------
vtkHybridTreePolygon::vtkHybridTreePolygon()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreePolygon::~vtkHybridTreePolygon() = default;

//------------------------------------------------------------------------------
void vtkHybridTreePolygon::SetNumberOfPoints(int count)
{
  if (count < 0 || count == this->GetNumberOfPoints())
  {
    return;
  }
  this->Points.resize(static_cast<std::size_t>(count), { 0.0, 0.0, 0.0 });
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkHybridTreePolygon::GetNumberOfPoints() const
{
  return static_cast<int>(this->Points.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreePolygon::SetPoint(int index, double x, double y, double z)
{
  if (index < 0 || index >= this->GetNumberOfPoints())
  {
    vtkErrorMacro(<< "There is no point " << index << " of " << this->GetNumberOfPoints()
                  << "; call SetNumberOfPoints first.");
    return;
  }
  const std::array<double, 3> point = { x, y, z };
  if (this->Points[static_cast<std::size_t>(index)] != point)
  {
    this->Points[static_cast<std::size_t>(index)] = point;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreePolygon::GetPoint(int index, double point[3]) const
{
  const bool exists = index >= 0 && index < this->GetNumberOfPoints();
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] =
      exists ? this->Points[static_cast<std::size_t>(index)][static_cast<std::size_t>(axis)] : 0.0;
  }
}

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreePolygon::MakeSkeleton()
{
  std::vector<hybridtree::Vec3> points;
  for (const std::array<double, 3>& point : this->Points)
  {
    points.emplace_back(point.data());
  }
  return std::make_shared<hybridtree::PolygonSkeleton>(std::move(points));
}

//------------------------------------------------------------------------------
void vtkHybridTreePolygon::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points: " << this->Points.size() << "\n";
  for (const std::array<double, 3>& point : this->Points)
  {
    os << indent.GetNextIndent() << point[0] << " " << point[1] << " " << point[2] << "\n";
  }
}
