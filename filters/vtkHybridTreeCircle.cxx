// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeCircle.h"

#include "core/skeletons/Circle.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeCircle);

//------------------------------------------------------------------------------
vtkHybridTreeCircle::vtkHybridTreeCircle() = default;
vtkHybridTreeCircle::~vtkHybridTreeCircle() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeCircle::MakeSkeleton()
{
  return std::make_shared<hybridtree::CircleSkeleton>(
    hybridtree::Vec3(this->Center), hybridtree::Vec3(this->Normal), this->Radius);
}

//------------------------------------------------------------------------------
void vtkHybridTreeCircle::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Normal: (" << this->Normal[0] << ", " << this->Normal[1] << ", "
     << this->Normal[2] << ")\n";
  os << indent << "Radius: " << this->Radius << "\n";
}
