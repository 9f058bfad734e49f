// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeConeSphere.h"

#include "core/skeletons/ConeSphere.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeConeSphere);

//------------------------------------------------------------------------------
vtkHybridTreeConeSphere::vtkHybridTreeConeSphere()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeConeSphere::~vtkHybridTreeConeSphere() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeConeSphere::MakeSkeleton()
{
  return std::make_shared<hybridtree::ConeSphereSkeleton>(
    hybridtree::Vec3(this->Point1), hybridtree::Vec3(this->Point2), this->Radius1, this->Radius2);
}

//------------------------------------------------------------------------------
void vtkHybridTreeConeSphere::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
  os << indent << "Radius1: " << this->Radius1 << "\n";
  os << indent << "Radius2: " << this->Radius2 << "\n";
}
