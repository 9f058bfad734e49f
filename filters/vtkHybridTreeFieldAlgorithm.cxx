// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFieldAlgorithm.h"

#include "core/nodes/Primitive.h"

vtkHybridTreeFieldAlgorithm::vtkHybridTreeFieldAlgorithm()
{
  this->SetNumberOfInputPorts(0);
}

vtkHybridTreeFieldAlgorithm::~vtkHybridTreeFieldAlgorithm() = default;

hybridtree::Potential vtkHybridTreeFieldAlgorithm::GetPotential() const
{
  return this->UsesMaximumField()
    ? hybridtree::Potential(this->GetSignedMaximum(), this->InfluenceRadius, this->Exponent)
    : hybridtree::Potential::bySurfaceRadius(
        this->SurfaceRadius, this->InfluenceRadius, this->Exponent, this->Negative);
}

vtkHybridTreeFieldAlgorithm::NodePtr vtkHybridTreeFieldAlgorithm::MakeNode(const Operands&)
{
  return hybridtree::makePrimitive(this->MakeSkeleton(), this->GetPotential());
}

void vtkHybridTreeFieldAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SurfaceRadius: " << this->SurfaceRadius << "\n";
}
