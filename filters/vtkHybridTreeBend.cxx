// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBend.h"

#include "core/nodes/Barr.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeBend);

//------------------------------------------------------------------------------
vtkHybridTreeBend::vtkHybridTreeBend() = default;
vtkHybridTreeBend::~vtkHybridTreeBend() = default;

//------------------------------------------------------------------------------
vtkHybridTreeBend::NodePtr vtkHybridTreeBend::MakeNode(const Operands& operands)
{
  const NodePtr& input = operands[0].front();
  return hybridtree::makeBend(
    input, this->GetFrame(*input), vtkMath::RadiansFromDegrees(this->Angle));
}

//------------------------------------------------------------------------------
void vtkHybridTreeBend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Angle: " << this->Angle << "\n";
}
