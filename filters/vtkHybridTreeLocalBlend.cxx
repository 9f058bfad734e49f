// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeLocalBlend.h"

#include "core/nodes/Boolean.h"
#include "core/nodes/LocalBlend.h"
#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeLocalBlend);

//------------------------------------------------------------------------------
vtkHybridTreeLocalBlend::vtkHybridTreeLocalBlend()
{
  this->SetNumberOfInputPorts(3);
}

vtkHybridTreeLocalBlend::~vtkHybridTreeLocalBlend() = default;

//------------------------------------------------------------------------------
vtkHybridTreeLocalBlend::NodePtr vtkHybridTreeLocalBlend::MakeNode(const Operands& operands)
{
  hybridtree::BlendOptions options;
  options.method = static_cast<hybridtree::BlendMethod>(this->Method);
  options.overlapThreshold = this->OverlapThreshold;
  NodePtr region = operands[2].front();
  for (std::size_t k = 1; k < operands[2].size(); ++k)
  {
    region = hybridtree::makeBoolean(hybridtree::BooleanOperation::Union, region, operands[2][k]);
  }
  return hybridtree::makeLocalBlend(operands[0].front(), operands[1].front(), region, options);
}

//------------------------------------------------------------------------------
int vtkHybridTreeLocalBlend::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
void vtkHybridTreeLocalBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "OverlapThreshold: " << this->OverlapThreshold << "\n";
}
