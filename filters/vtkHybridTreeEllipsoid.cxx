// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeEllipsoid.h"

#include "core/skeletons/Ellipsoid.h"
#include "vtkHybridTreeRotation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeEllipsoid);

//------------------------------------------------------------------------------
vtkHybridTreeEllipsoid::vtkHybridTreeEllipsoid()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeEllipsoid::~vtkHybridTreeEllipsoid() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeEllipsoid::MakeSkeleton()
{
  return std::make_shared<hybridtree::EllipsoidSkeleton>(hybridtree::Vec3(this->Center),
    hybridtree::Vec3(this->Radii), hybridtree::rotationOf(this->Rotation));
}

//------------------------------------------------------------------------------
void vtkHybridTreeEllipsoid::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
  os << indent << "Radii: (" << this->Radii[0] << ", " << this->Radii[1] << ", " << this->Radii[2]
     << ")\n";
  os << indent << "Rotation: (" << this->Rotation[0] << ", " << this->Rotation[1] << ", "
     << this->Rotation[2] << ")\n";
}
