// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeMeshField.h"

#include "core/base/Error.h"
#include "core/nodes/MeshNode.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeMeshField);

//------------------------------------------------------------------------------
vtkHybridTreeMeshField::vtkHybridTreeMeshField() = default;
vtkHybridTreeMeshField::~vtkHybridTreeMeshField() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeMeshField::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  info->Set(TAKES_TREE(), 0); // the mesh itself is wanted
  return filled;
}

//------------------------------------------------------------------------------
vtkHybridTreeMeshField::NodePtr vtkHybridTreeMeshField::MakeNode(const Operands& operands)
{
  const hybridtree::MeshPtr mesh = operands[0].front()->leafMesh();
  double maximum = 2.0 * hybridtree::kThreshold;
  if (this->FieldMode == MAXIMUM_FIELD)
  {
    maximum = this->MaximumField;
    if (!(maximum > 0.0))
    {
      throw hybridtree::InvalidParameter(
        "MaximumField", maximum, "0.5 or more; switch Negative on to carve");
    }
  }
  const double radius = this->InfluenceRadius == 0.0 ? hybridtree::defaultInfluenceRadius(*mesh)
                                                     : this->InfluenceRadius;
  return hybridtree::makeMeshNode(
    mesh, this->Negative ? -maximum : maximum, radius, this->Exponent);
}

//------------------------------------------------------------------------------
void vtkHybridTreeMeshField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FieldMode: " << this->FieldMode << "\n";
  os << indent << "MaximumField: " << this->MaximumField << "\n";
  os << indent << "InfluenceRadius: " << this->InfluenceRadius << "\n";
  os << indent << "Exponent: " << this->Exponent << "\n";
  os << indent << "Negative: " << this->Negative << "\n";
}
