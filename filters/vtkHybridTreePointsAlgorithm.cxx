// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePointsAlgorithm.h"

#include "vtkHybridTreeIndexedList.h"

#include <algorithm>

//------------------------------------------------------------------------------
vtkHybridTreePointsAlgorithm::vtkHybridTreePointsAlgorithm() = default;
vtkHybridTreePointsAlgorithm::~vtkHybridTreePointsAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::SetNumberOfPoints(int count)
{
  if (hybridtree::setCount(this->Points, count))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkHybridTreePointsAlgorithm::GetNumberOfPoints() const
{
  return static_cast<int>(this->Points.size());
}

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::SetPoint(int index, double x, double y, double z)
{
  if (!hybridtree::has(this->Points, index))
  {
    vtkErrorMacro("There is no point " << index << ": Points has " << this->GetNumberOfPoints()
                                       << ". Call SetNumberOfPoints first.");
  }
  else if (hybridtree::setElement(this->Points, index, { x, y, z }))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::GetPoint(int index, double point[3]) const
{
  const std::array<double, 3> value = hybridtree::has(this->Points, index)
    ? this->Points[static_cast<std::size_t>(index)]
    : std::array<double, 3>{};
  std::copy(value.begin(), value.end(), point);
}

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points:";
  hybridtree::print(this->Points, os);
  os << "\n";
}
