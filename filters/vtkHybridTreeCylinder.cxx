// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeCylinder.h"

#include "core/skeletons/Cylinder.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeCylinder);

//------------------------------------------------------------------------------
vtkHybridTreeCylinder::vtkHybridTreeCylinder()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeCylinder::~vtkHybridTreeCylinder() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeCylinder::MakeSkeleton()
{
  return std::make_shared<hybridtree::CylinderSkeleton>(
    hybridtree::Vec3(this->Point1), hybridtree::Vec3(this->Point2), this->Radius);
}

//------------------------------------------------------------------------------
void vtkHybridTreeCylinder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
}
