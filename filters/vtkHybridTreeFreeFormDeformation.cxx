// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeFreeFormDeformation.h"

#include "core/base/Error.h"
#include "core/nodes/FreeForm.h"
#include "vtkCellArray.h"
#include "vtkHybridTreeBounds.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkHybridTreeFreeFormDeformation);

//------------------------------------------------------------------------------
vtkHybridTreeFreeFormDeformation::vtkHybridTreeFreeFormDeformation()
{
  this->SetNumberOfOutputPorts(2);
}

vtkHybridTreeFreeFormDeformation::~vtkHybridTreeFreeFormDeformation() = default;

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::SetNumberOfDisplacements(int count)
{
  const auto size = static_cast<std::size_t>(std::max(count, 0));
  if (size != this->Displacements.size())
  {
    Displacement unset;
    unset.fill(std::numeric_limits<double>::quiet_NaN());
    this->Displacements.resize(size, unset);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkHybridTreeFreeFormDeformation::GetNumberOfDisplacements() const
{
  return static_cast<int>(this->Displacements.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::SetDisplacement(
  int row, double i, double j, double k, double dx, double dy, double dz)
{
  if (row < 0 || row >= this->GetNumberOfDisplacements())
  {
    vtkErrorMacro("Displacements has " << this->GetNumberOfDisplacements()
                                       << " rows, there is no row " << row
                                       << ". Call SetNumberOfDisplacements first.");
    return;
  }
  const Displacement values{ i, j, k, dx, dy, dz };
  const auto index = static_cast<std::size_t>(row);
  if (this->Displacements[index] != values)
  {
    this->Displacements[index] = values;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::AddDisplacement(
  double i, double j, double k, double dx, double dy, double dz)
{
  this->Displacements.push_back({ i, j, k, dx, dy, dz });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::ClearDisplacements()
{
  this->SetNumberOfDisplacements(0);
}

//------------------------------------------------------------------------------
hybridtree::FreeFormLattice vtkHybridTreeFreeFormDeformation::GetLattice(
  const hybridtree::Node& input) const
{
  using hybridtree::Vec3;
  hybridtree::FreeFormLattice lattice;
  std::copy_n(this->LatticeDimensions, 3, lattice.dimensions.begin());
  if (this->FitLattice)
  {
    // A margin, so that no part of the surface lies on a face of the box.
    hybridtree::Box3 box = hybridtree::boundsToFit(input);
    const Vec3 margin = Vec3::Constant(0.01 * box.diagonal().norm());
    box = hybridtree::Box3(box.min() - margin, box.max() + margin);
    lattice.origin = box.min();
    lattice.axes = box.sizes().asDiagonal();
  }
  else
  {
    lattice.origin = Vec3(this->LatticeOrigin);
    lattice.axes = hybridtree::Mat3(this->LatticeAxes); // column after column
  }
  this->MoveControlPoints(lattice);
  return lattice;
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::MoveControlPoints(hybridtree::FreeFormLattice& lattice) const
{
  const std::array<int, 3>& size = lattice.dimensions;
  if (this->Displacements.empty() ||
    std::any_of(
      size.begin(), size.end(), [](int n) { return n < 2 || n > hybridtree::kLargestLattice; }))
  {
    return; // the node says what is wrong with the dimensions
  }
  lattice.displacements.assign(
    static_cast<std::size_t>(size[0] * size[1] * size[2]), hybridtree::Vec3::Zero());
  for (std::size_t row = 0; row < this->Displacements.size(); ++row)
  {
    const Displacement& values = this->Displacements[row];
    std::array<long, 3> index;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!(0.0 <= values[axis] && values[axis] <= size[axis] - 1) ||
        values[axis] != std::floor(values[axis]))
      {
        throw hybridtree::InvalidParameter("Index " + std::string(1, "ijk"[axis]) + " of row " +
            std::to_string(row) + " of Displacements",
          values[axis],
          "a whole number from 0 to " + std::to_string(size[axis] - 1) +
            ", one less than LatticeDimensions; a row has six numbers, i j k dx dy dz");
      }
      index[axis] = static_cast<long>(values[axis]);
    }
    lattice.displacements[static_cast<std::size_t>(
      index[0] + size[0] * (index[1] + size[1] * index[2]))] +=
      hybridtree::Vec3(values[3], values[4], values[5]);
  }
}

//------------------------------------------------------------------------------
vtkHybridTreeFreeFormDeformation::NodePtr vtkHybridTreeFreeFormDeformation::MakeNode(
  const Operands& operands)
{
  const NodePtr& input = operands[0].front();
  const hybridtree::FreeFormLattice lattice = this->GetLattice(*input);
  const auto from = static_cast<hybridtree::FieldFrom>(this->FieldFrom);
  NodePtr node = hybridtree::makeFreeForm(input, lattice, from, this->EdgeLength);
  this->Drawing = std::make_unique<hybridtree::ControlLattice>(hybridtree::controlLattice(lattice));
  return node;
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::FillOtherOutputs(vtkInformationVector* outputs)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  for (const hybridtree::Vec3& point : this->Drawing->points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> lines;
  for (const auto& edge : this->Drawing->edges)
  {
    const vtkIdType ends[2] = { edge[0], edge[1] };
    lines->InsertNextCell(2, ends);
  }
  vtkPolyData* output = vtkPolyData::GetData(outputs, 1);
  output->SetPoints(points);
  output->SetLines(lines);
}

//------------------------------------------------------------------------------
void vtkHybridTreeFreeFormDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LatticeDimensions: (" << this->LatticeDimensions[0] << ", "
     << this->LatticeDimensions[1] << ", " << this->LatticeDimensions[2] << ")\n";
  os << indent << "FitLattice: " << this->FitLattice << "\n";
  os << indent << "LatticeOrigin: (" << this->LatticeOrigin[0] << ", " << this->LatticeOrigin[1]
     << ", " << this->LatticeOrigin[2] << ")\n";
  os << indent << "LatticeAxes:";
  for (double value : this->LatticeAxes)
  {
    os << " " << value;
  }
  os << "\n";
  os << indent << "FieldFrom: " << this->FieldFrom << "\n";
  os << indent << "Displacements: " << this->Displacements.size() << " rows\n";
}
