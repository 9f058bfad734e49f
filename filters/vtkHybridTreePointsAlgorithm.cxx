// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePointsAlgorithm.h"

#include <algorithm>

//------------------------------------------------------------------------------
vtkHybridTreePointsAlgorithm::vtkHybridTreePointsAlgorithm() = default;
vtkHybridTreePointsAlgorithm::~vtkHybridTreePointsAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::SetNumberOfPoints(int count)
{
  const auto size = static_cast<std::size_t>(std::max(count, 0));
  if (size != this->Points.size())
  {
    this->Points.resize(size, { 0.0, 0.0, 0.0 });
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
  if (index < 0 || index >= this->GetNumberOfPoints())
  {
    vtkErrorMacro("There is no point " << index << ": Points has " << this->GetNumberOfPoints()
                                       << ". Call SetNumberOfPoints first.");
    return;
  }
  const std::array<double, 3> point{ x, y, z };
  if (this->Points[static_cast<std::size_t>(index)] != point)
  {
    this->Points[static_cast<std::size_t>(index)] = point;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::GetPoint(int index, double point[3]) const
{
  const bool exists = index >= 0 && index < this->GetNumberOfPoints();
  const std::array<double, 3> value =
    exists ? this->Points[static_cast<std::size_t>(index)] : std::array<double, 3>{};
  std::copy(value.begin(), value.end(), point);
}

//------------------------------------------------------------------------------
void vtkHybridTreePointsAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points:";
  for (const std::array<double, 3>& point : this->Points)
  {
    os << " (" << point[0] << ", " << point[1] << ", " << point[2] << ")";
  }
  os << "\n";
}
