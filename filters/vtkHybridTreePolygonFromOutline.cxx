// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePolygonFromOutline.h"

#include "core/base/Error.h"
#include "core/skeletons/Polygon.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkHybridTreePolygonFromOutline);

namespace
{

using Ids = std::vector<vtkIdType>;

std::vector<Ids> cellsOf(vtkCellArray* cells)
{
  std::vector<Ids> result;
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    result.emplace_back(ids, ids + size);
  }
  return result;
}

// The first loop that lines make, from end to end of each; empty when none closes.
Ids firstLoop(const std::vector<Ids>& lines)
{
  std::unordered_multimap<vtkIdType, std::size_t> at; // lines by both their ends
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    if (lines[k].size() > 1)
    {
      at.emplace(lines[k].front(), k);
      at.emplace(lines[k].back(), k);
    }
  }
  std::vector<char> used(lines.size(), 0);
  for (std::size_t first = 0; first < lines.size(); ++first)
  {
    if (used[first] || lines[first].size() < 2)
    {
      continue;
    }
    Ids loop = lines[first];
    used[first] = 1;
    while (loop.back() != loop.front())
    {
      const auto [begin, end] = at.equal_range(loop.back());
      const auto next =
        std::find_if(begin, end, [&](const auto& entry) { return !used[entry.second]; });
      if (next == end)
      {
        break;
      }
      Ids line = lines[next->second];
      used[next->second] = 1;
      if (line.front() != loop.back())
      {
        std::reverse(line.begin(), line.end());
      }
      loop.insert(loop.end(), line.begin() + 1, line.end());
    }
    if (loop.back() == loop.front() && loop.size() > 3)
    {
      loop.pop_back();
      return loop;
    }
  }
  return {};
}

Ids outlineOf(vtkPolyData* input)
{
  const std::vector<Ids> polygons = cellsOf(input->GetPolys());
  const Ids outline = polygons.empty() ? firstLoop(cellsOf(input->GetLines())) : polygons.front();
  if (outline.empty())
  {
    throw hybridtree::InvalidGeometry("The input has " +
      std::to_string(input->GetNumberOfPoints()) + " points and " +
      std::to_string(input->GetNumberOfLines()) +
      " lines, but neither a polygon nor lines that close. Close the outline, or merge its equal "
      "points with Clean.");
  }
  return outline;
}

} // namespace

//------------------------------------------------------------------------------
vtkHybridTreePolygonFromOutline::vtkHybridTreePolygonFromOutline()
{
  this->SetNumberOfInputPorts(1);
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreePolygonFromOutline::~vtkHybridTreePolygonFromOutline() = default;

//------------------------------------------------------------------------------
int vtkHybridTreePolygonFromOutline::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  info->Set(TAKES_TREE(), 0); // the outline itself is wanted
  return filled;
}

//------------------------------------------------------------------------------
bool vtkHybridTreePolygonFromOutline::TakesNodes(int)
{
  return false;
}

//------------------------------------------------------------------------------
bool vtkHybridTreePolygonFromOutline::ReadOtherInputs(vtkInformationVector** inputs)
{
  this->Input = vtkPolyData::GetData(inputs[0]);
  if (!this->Input)
  {
    throw hybridtree::InvalidGeometry("There is no data. Check the filter it comes from.");
  }
  return std::exchange(this->InputTime, this->Input->GetMTime()) != this->Input->GetMTime();
}

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreePolygonFromOutline::MakeSkeleton()
{
  std::vector<hybridtree::Vec3> points;
  for (const vtkIdType id : outlineOf(this->Input))
  {
    double point[3];
    this->Input->GetPoint(id, point);
    points.emplace_back(point);
  }
  return std::make_shared<hybridtree::PolygonSkeleton>(std::move(points));
}
