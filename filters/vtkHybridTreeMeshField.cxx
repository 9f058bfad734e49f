// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeMeshField.h"

#include "core/nodes/MeshNode.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeMeshField);

//------------------------------------------------------------------------------
vtkHybridTreeMeshField::vtkHybridTreeMeshField()
{
  this->InfluenceRadius = 0.0;
}

vtkHybridTreeMeshField::~vtkHybridTreeMeshField() = default;

//------------------------------------------------------------------------------
void vtkHybridTreeMeshField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CloseHoles: " << this->CloseHoles << "\n";
}

//------------------------------------------------------------------------------
bool vtkHybridTreeMeshField::ClosesHoles()
{
  return this->CloseHoles;
}

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
  const double byDefault = (this->Negative ? -2.0 : 2.0) * hybridtree::kThreshold;
  const double maximum = this->UsesMaximumField() ? this->GetSignedMaximum() : byDefault;
  const double radius = this->InfluenceRadius == 0.0 ? hybridtree::defaultInfluenceRadius(*mesh)
                                                     : this->InfluenceRadius;
  return hybridtree::makeMeshNode(mesh, maximum, radius, this->Exponent);
}
