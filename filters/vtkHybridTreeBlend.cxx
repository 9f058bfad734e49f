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
  hybridtree::BlendOptions options;
  options.method = static_cast<hybridtree::BlendMethod>(this->Method);
  options.overlapThreshold = this->OverlapThreshold;
  return hybridtree::makeBlend(operands[0], options);
}

//------------------------------------------------------------------------------
int vtkHybridTreeBlend::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
void vtkHybridTreeBlend::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "OverlapThreshold: " << this->OverlapThreshold << "\n";
}
