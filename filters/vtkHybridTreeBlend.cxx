// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBlend.h"

#include "core/nodes/Blend.h"
#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeBlend);

//------------------------------------------------------------------------------
vtkHybridTreeBlend::vtkHybridTreeBlend() = default;
vtkHybridTreeBlend::~vtkHybridTreeBlend() = default;

//------------------------------------------------------------------------------
vtkHybridTreeBlend::NodePtr vtkHybridTreeBlend::MakeNode(const Operands& operands)
{
  return hybridtree::makeBlend(operands[0], this->GetOptions());
}

//------------------------------------------------------------------------------
int vtkHybridTreeBlend::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}
