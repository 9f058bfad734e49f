// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSegment.h"

#include "core/skeletons/Segment.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeSegment);

//------------------------------------------------------------------------------
vtkHybridTreeSegment::vtkHybridTreeSegment() = default;
vtkHybridTreeSegment::~vtkHybridTreeSegment() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeSegment::MakeSkeleton()
{
  return std::make_shared<hybridtree::SegmentSkeleton>(
    hybridtree::Vec3(this->Point1), hybridtree::Vec3(this->Point2));
}

//------------------------------------------------------------------------------
void vtkHybridTreeSegment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: (" << this->Point1[0] << ", " << this->Point1[1] << ", "
     << this->Point1[2] << ")\n";
  os << indent << "Point2: (" << this->Point2[0] << ", " << this->Point2[1] << ", "
     << this->Point2[2] << ")\n";
}
