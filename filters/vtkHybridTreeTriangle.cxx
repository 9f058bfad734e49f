// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeTriangle.h"

#include "core/skeletons/Triangle.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeTriangle);

//------------------------------------------------------------------------------
vtkHybridTreeTriangle::vtkHybridTreeTriangle()
{
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeTriangle::~vtkHybridTreeTriangle() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeTriangle::MakeSkeleton()
{
  return std::make_shared<hybridtree::TriangleSkeleton>(
    hybridtree::Vec3(this->Point1), hybridtree::Vec3(this->Point2), hybridtree::Vec3(this->Point3));
}

//------------------------------------------------------------------------------
void vtkHybridTreeTriangle::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
  os << indent << "Point3: (" << this->Point3[0] << ", " << this->Point3[1] << ", "
     << this->Point3[2] << ")\n";
}
