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
  return this->GetPotential(this->SurfaceRadius, this->InfluenceRadius);
}

hybridtree::Potential vtkHybridTreeFieldAlgorithm::GetPotential(
  double surfaceRadius, double influenceRadius) const
{
  return this->UsesMaximumField()
    ? hybridtree::Potential(this->GetSignedMaximum(), influenceRadius, this->Exponent)
    : hybridtree::Potential::bySurfaceRadius(
        surfaceRadius, influenceRadius, this->Exponent, this->Negative);
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
