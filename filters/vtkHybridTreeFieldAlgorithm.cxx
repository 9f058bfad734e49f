// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFieldAlgorithm.h"

#include "core/base/Error.h"
#include "core/nodes/Primitive.h"

vtkHybridTreeFieldAlgorithm::vtkHybridTreeFieldAlgorithm()
{
  this->SetNumberOfInputPorts(0);
}

vtkHybridTreeFieldAlgorithm::~vtkHybridTreeFieldAlgorithm() = default;

hybridtree::Potential vtkHybridTreeFieldAlgorithm::GetPotential() const
{
  if (this->FieldMode == SURFACE_RADIUS)
  {
    return hybridtree::Potential::bySurfaceRadius(
      this->SurfaceRadius, this->InfluenceRadius, this->Exponent, this->Negative);
  }
  if (!(this->MaximumField > 0.0))
  {
    throw hybridtree::InvalidParameter(
      "MaximumField", this->MaximumField, "greater than 0; switch Negative on to carve");
  }
  return hybridtree::Potential(this->Negative ? -this->MaximumField : this->MaximumField,
    this->InfluenceRadius, this->Exponent);
}

vtkHybridTreeFieldAlgorithm::NodePtr vtkHybridTreeFieldAlgorithm::MakeNode(const Operands&)
{
  return hybridtree::makePrimitive(this->MakeSkeleton(), this->GetPotential());
}

void vtkHybridTreeFieldAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FieldMode: " << this->FieldMode << "\n";
  os << indent << "SurfaceRadius: " << this->SurfaceRadius << "\n";
  os << indent << "MaximumField: " << this->MaximumField << "\n";
  os << indent << "InfluenceRadius: " << this->InfluenceRadius << "\n";
  os << indent << "Exponent: " << this->Exponent << "\n";
  os << indent << "Negative: " << this->Negative << "\n";
}
