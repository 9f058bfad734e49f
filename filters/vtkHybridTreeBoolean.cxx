// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBoolean.h"

#include "core/nodes/Boolean.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeBoolean);

//------------------------------------------------------------------------------
vtkHybridTreeBoolean::vtkHybridTreeBoolean()
{
  this->SetNumberOfInputPorts(2);
}

vtkHybridTreeBoolean::~vtkHybridTreeBoolean() = default;

//------------------------------------------------------------------------------
vtkHybridTreeBoolean::NodePtr vtkHybridTreeBoolean::MakeNode(const Operands& operands)
{
  return hybridtree::makeBoolean(static_cast<hybridtree::BooleanOperation>(this->Operation),
    operands[0].front(), operands[1].front(), static_cast<hybridtree::BooleanForm>(this->Form));
}

//------------------------------------------------------------------------------
void vtkHybridTreeBoolean::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Operation: " << this->Operation << "\n";
  os << indent << "Form: " << this->Form << "\n";
}
