// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBox.h"

#include "core/skeletons/Box.h"
#include "vtkHybridTreeRotation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeBox);

//------------------------------------------------------------------------------
vtkHybridTreeBox::vtkHybridTreeBox() = default;
vtkHybridTreeBox::~vtkHybridTreeBox() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeBox::MakeSkeleton()
{
  return std::make_shared<hybridtree::BoxSkeleton>(hybridtree::Vec3(this->Center),
    hybridtree::Vec3(this->Lengths), hybridtree::rotationOf(this->Rotation));
}

//------------------------------------------------------------------------------
void vtkHybridTreeBox::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Lengths: (" << this->Lengths[0] << ", " << this->Lengths[1] << ", "
     << this->Lengths[2] << ")\n";
  os << indent << "Rotation: (" << this->Rotation[0] << ", " << this->Rotation[1] << ", "
     << this->Rotation[2] << ")\n";
}
