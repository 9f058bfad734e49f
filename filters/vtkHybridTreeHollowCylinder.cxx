// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeHollowCylinder.h"

#include "core/skeletons/HollowCylinder.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeHollowCylinder);

//------------------------------------------------------------------------------
vtkHybridTreeHollowCylinder::vtkHybridTreeHollowCylinder()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeHollowCylinder::~vtkHybridTreeHollowCylinder() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeHollowCylinder::MakeSkeleton()
{
  return std::make_shared<hybridtree::HollowCylinderSkeleton>(hybridtree::Vec3(this->Point1),
    hybridtree::Vec3(this->Point2), this->OuterRadius, this->InnerRadius);
}

//------------------------------------------------------------------------------
void vtkHybridTreeHollowCylinder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
  os << indent << "OuterRadius: " << this->OuterRadius << "\n";
  os << indent << "InnerRadius: " << this->InnerRadius << "\n";
}
