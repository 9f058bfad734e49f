// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSubdivisionSkeleton.h"

#include "core/base/Error.h"
#include "core/nodes/SubdivisionSkeletonMesh.h"
#include "vtkHybridTreeSkeletonData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <utility>

vtkStandardNewMacro(vtkHybridTreeSubdivisionSkeleton);

//------------------------------------------------------------------------------
vtkHybridTreeSubdivisionSkeleton::vtkHybridTreeSubdivisionSkeleton()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

vtkHybridTreeSubdivisionSkeleton::~vtkHybridTreeSubdivisionSkeleton() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeSubdivisionSkeleton::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  info->Set(TAKES_TREE(), 0); // the lines and triangles themselves are wanted
  return filled;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeSubdivisionSkeleton::TakesNodes(int)
{
  return false;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeSubdivisionSkeleton::ReadOtherInputs()
{
  this->Input = this->GetWholeInput(0);
  if (!this->Input)
  {
    throw hybridtree::InvalidGeometry("There is no data. Check the filter it comes from.");
  }
  return std::exchange(this->InputTime, this->Input->GetMTime()) != this->Input->GetMTime();
}

//------------------------------------------------------------------------------
vtkHybridTreeSubdivisionSkeleton::NodePtr vtkHybridTreeSubdivisionSkeleton::MakeNode(
  const Operands&)
{
  hybridtree::SubdivisionSkeletonOptions options;
  options.scheme = hybridtree::toScheme(this->Scheme);
  options.level = this->Level;
  options.kernel.kind = static_cast<hybridtree::KernelKind>(this->Kernel);
  options.kernel.exponent = this->Exponent;
  options.kernel.influenceRatio = this->InfluenceRatio;
  options.blending = { static_cast<hybridtree::BlendingKind>(this->Blending), this->BlendDistance };
  options.refinement = this->Refinement;
  options.radius = static_cast<hybridtree::SkeletonRadius>(this->RadiusInterpolation);
  options.negative = this->Negative;
  return hybridtree::makeSubdivisionSkeleton(
    hybridtree::toSkeleton(this->Input, this->RadiusArray, this->Radius), options);
}

//------------------------------------------------------------------------------
vtkHybridTreeSubdivisionSkeleton::MeshPtr vtkHybridTreeSubdivisionSkeleton::MakeMesh(
  const hybridtree::Node& node, const hybridtree::Progress& progress)
{
  if (!this->Preview)
  {
    return this->Superclass::MakeMesh(node, progress);
  }
  const auto mesh =
    std::make_shared<hybridtree::TriangleMesh>(hybridtree::subdivisionSkeletonPreview(
      static_cast<const hybridtree::SubdivisionSkeleton&>(node), progress));
  if (mesh->triangles.empty() && !this->Negative)
  {
    vtkWarningMacro(
      "The skeleton has no surface: it is too short beside its radius. Make the radius "
      "or InfluenceRatio smaller.");
  }
  return mesh;
}

//------------------------------------------------------------------------------
void vtkHybridTreeSubdivisionSkeleton::FillOtherOutputs(vtkInformationVector* outputs)
{
  const auto& node = static_cast<const hybridtree::SubdivisionSkeleton&>(*this->GetTree());
  hybridtree::toPolyData(
    node.refined(), node.coarse().segments.size(), vtkPolyData::GetData(outputs, 1));
}

//------------------------------------------------------------------------------
void vtkHybridTreeSubdivisionSkeleton::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << this->RadiusArray << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "RadiusInterpolation: " << this->RadiusInterpolation << "\n";
  os << indent << "Scheme: " << this->Scheme << "\n";
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "Blending: " << this->Blending << "\n";
  os << indent << "BlendDistance: " << this->BlendDistance << "\n";
  os << indent << "Kernel: " << this->Kernel << "\n";
  os << indent << "InfluenceRatio: " << this->InfluenceRatio << "\n";
  os << indent << "Exponent: " << this->Exponent << "\n";
  os << indent << "Negative: " << this->Negative << "\n";
  os << indent << "Refinement: " << this->Refinement << "\n";
  os << indent << "Preview: " << this->Preview << "\n";
}
