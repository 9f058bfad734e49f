// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeTwist.h"

#include "core/nodes/Barr.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeTwist);

//------------------------------------------------------------------------------
vtkHybridTreeTwist::vtkHybridTreeTwist() = default;
vtkHybridTreeTwist::~vtkHybridTreeTwist() = default;

//------------------------------------------------------------------------------
vtkHybridTreeTwist::NodePtr vtkHybridTreeTwist::MakeNode(const Operands& operands)
{
  const NodePtr& input = operands[0].front();
  return hybridtree::makeTwist(
    input, this->GetFrameAroundAxis(*input), vtkMath::RadiansFromDegrees(this->Angle));
}

//------------------------------------------------------------------------------
void vtkHybridTreeTwist::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Angle: " << this->Angle << "\n";
}
