// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeTaper.h"

#include "core/nodes/Barr.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeTaper);

//------------------------------------------------------------------------------
vtkHybridTreeTaper::vtkHybridTreeTaper() = default;
vtkHybridTreeTaper::~vtkHybridTreeTaper() = default;

//------------------------------------------------------------------------------
vtkHybridTreeTaper::NodePtr vtkHybridTreeTaper::MakeNode(const Operands& operands)
{
  const NodePtr& input = operands[0].front();
  return hybridtree::makeTaper(input, this->GetFrameAroundAxis(*input), this->Factor);
}

//------------------------------------------------------------------------------
void vtkHybridTreeTaper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Factor: " << this->Factor << "\n";
}
