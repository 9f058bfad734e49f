// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBlendAlgorithm.h"

#include "core/nodes/Blend.h"

//------------------------------------------------------------------------------
vtkHybridTreeBlendAlgorithm::vtkHybridTreeBlendAlgorithm() = default;
vtkHybridTreeBlendAlgorithm::~vtkHybridTreeBlendAlgorithm() = default;

//------------------------------------------------------------------------------
hybridtree::BlendOptions vtkHybridTreeBlendAlgorithm::GetOptions() const
{
  hybridtree::BlendOptions options;
  options.method = static_cast<hybridtree::BlendMethod>(this->Method);
  options.overlapThreshold = this->OverlapThreshold;
  return options;
}

//------------------------------------------------------------------------------
void vtkHybridTreeBlendAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "OverlapThreshold: " << this->OverlapThreshold << "\n";
}
