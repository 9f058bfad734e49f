// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeRectangle.h"

#include "core/skeletons/Rectangle.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeRectangle);

//------------------------------------------------------------------------------
vtkHybridTreeRectangle::vtkHybridTreeRectangle()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeRectangle::~vtkHybridTreeRectangle() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeRectangle::MakeSkeleton()
{
  return std::make_shared<hybridtree::RectangleSkeleton>(
    hybridtree::Vec3(this->Origin), hybridtree::Vec3(this->Point1), hybridtree::Vec3(this->Point2));
}

//------------------------------------------------------------------------------
void vtkHybridTreeRectangle::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Origin: (" << this->Origin[0] << ", " << this->Origin[1] << ", "
     << this->Origin[2] << ")\n";
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
}
