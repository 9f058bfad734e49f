// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBoolean.h"

#include "core/nodes/BooleanNest.h"
#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkHybridTreeBoolean);

//------------------------------------------------------------------------------
vtkHybridTreeBoolean::vtkHybridTreeBoolean() : Nest(std::make_unique<hybridtree::BooleanNest>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkHybridTreeBoolean::~vtkHybridTreeBoolean() = default;

//------------------------------------------------------------------------------
void vtkHybridTreeBoolean::RemoveAllB()
{
  this->SetInputConnection(1, nullptr);
}

//------------------------------------------------------------------------------
vtkHybridTreeBoolean::NodePtr vtkHybridTreeBoolean::MakeNode(const Operands& operands)
{
  std::vector<NodePtr> all = operands[0];
  all.insert(all.end(), operands[1].begin(), operands[1].end());
  return this->Nest->make(static_cast<hybridtree::BooleanOperation>(this->Operation), all,
    static_cast<hybridtree::BooleanForm>(this->Form),
    static_cast<hybridtree::FacetMerging>(this->MergeCoplanar));
}

//------------------------------------------------------------------------------
const char* vtkHybridTreeBoolean::InputName(int port)
{
  return port == 0 ? "A" : "B";
}

//------------------------------------------------------------------------------
int vtkHybridTreeBoolean::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
void vtkHybridTreeBoolean::FillOtherOutputs(vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 1);
  if (hybridtree::requested(outputs->GetInformationObject(0)) != hybridtree::Formulation::Mesh)
  {
    output->Initialize(); // nobody wants a mesh, and without it there are no curves
    return;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  vtkNew<vtkCellArray> lines;
  for (const auto& curve : hybridtree::intersectionCurves(*this->GetTree(), this->EdgeLength))
  {
    const bool closed = curve.front() == curve.back();
    const vtkIdType first = points->GetNumberOfPoints();
    lines->InsertNextCell(static_cast<int>(curve.size()));
    for (std::size_t k = 0; k < curve.size(); ++k)
    {
      const bool back = closed && k + 1 == curve.size();
      lines->InsertCellPoint(back ? first : points->InsertNextPoint(curve[k].data()));
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
}

//------------------------------------------------------------------------------
void vtkHybridTreeBoolean::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Operation: " << this->Operation << "\n";
  os << indent << "Form: " << this->Form << "\n";
  os << indent << "MergeCoplanar: " << this->MergeCoplanar << "\n";
}
