// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeDisc.h"

#include "core/skeletons/Disc.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeDisc);

//------------------------------------------------------------------------------
vtkHybridTreeDisc::vtkHybridTreeDisc()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeDisc::~vtkHybridTreeDisc() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeDisc::MakeSkeleton()
{
  return std::make_shared<hybridtree::DiscSkeleton>(
    hybridtree::Vec3(this->Center), hybridtree::Vec3(this->Normal), this->Radius);
}

//------------------------------------------------------------------------------
void vtkHybridTreeDisc::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Normal: (" << this->Normal[0] << ", " << this->Normal[1] << ", "
     << this->Normal[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
}
