// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeLeafAlgorithm.h"

#include "core/base/Error.h"

//------------------------------------------------------------------------------
vtkHybridTreeLeafAlgorithm::vtkHybridTreeLeafAlgorithm() = default;
vtkHybridTreeLeafAlgorithm::~vtkHybridTreeLeafAlgorithm() = default;

//------------------------------------------------------------------------------
bool vtkHybridTreeLeafAlgorithm::UsesMaximumField() const
{
  if (this->FieldMode != AUTOMATIC && this->FieldMode != MAXIMUM_FIELD)
  {
    throw hybridtree::InvalidParameter(
      "FieldMode", this->FieldMode, "0 (by the surface) or 1 (by MaximumField)");
  }
  return this->FieldMode == MAXIMUM_FIELD;
}

//------------------------------------------------------------------------------
double vtkHybridTreeLeafAlgorithm::GetSignedMaximum() const
{
  if (!(this->MaximumField > 0.0))
  {
    throw hybridtree::InvalidParameter(
      "MaximumField", this->MaximumField, "greater than 0; switch Negative on to carve");
  }
  return this->Negative ? -this->MaximumField : this->MaximumField;
}

//------------------------------------------------------------------------------
void vtkHybridTreeLeafAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FieldMode: " << this->FieldMode << "\n";
  os << indent << "MaximumField: " << this->MaximumField << "\n";
  os << indent << "InfluenceRadius: " << this->InfluenceRadius << "\n";
  os << indent << "Exponent: " << this->Exponent << "\n";
  os << indent << "Negative: " << this->Negative << "\n";
}
