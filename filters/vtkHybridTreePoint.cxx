// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePoint.h"

#include "core/skeletons/Point.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreePoint);

vtkHybridTreePoint::vtkHybridTreePoint() = default;
vtkHybridTreePoint::~vtkHybridTreePoint() = default;

std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreePoint::MakeSkeleton()
{
  return std::make_shared<hybridtree::PointSkeleton>(hybridtree::Vec3(this->Center));
}

void vtkHybridTreePoint::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Center: (" << this->Center[0] << ", " << this->Center[1] << ", "
     << this->Center[2] << ")\n";
}
