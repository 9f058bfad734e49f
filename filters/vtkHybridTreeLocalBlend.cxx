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
  NodePtr region = operands[2].front();
  for (std::size_t k = 1; k < operands[2].size(); ++k)
  {
    region = hybridtree::makeBoolean(hybridtree::BooleanOperation::Union, region, operands[2][k]);
  }
  return hybridtree::makeLocalBlend(
    operands[0].front(), operands[1].front(), region, this->GetOptions());
}

//------------------------------------------------------------------------------
const char* vtkHybridTreeLocalBlend::InputName(int port)
{
  return port == 0 ? "A" : port == 1 ? "B" : "Region";
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
