// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePolygonFromOutline.h"

#include "core/base/Error.h"
#include "core/skeletons/Polygon.h"
#include "vtkHybridTreePaths.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkHybridTreePolygonFromOutline);

namespace
{

// The first polygon, or else the first loop of the lines.
hybridtree::Path outlineOf(vtkPolyData* input)
{
  for (const auto& paths : { hybridtree::polygonsOf(input), hybridtree::pathsOf(input) })
  {
    const auto outline =
      std::find_if(paths.begin(), paths.end(), [](const auto& path) { return path.closed; });
    if (outline != paths.end())
    {
      return *outline;
    }
  }
  throw hybridtree::InvalidGeometry("The input has " + std::to_string(input->GetNumberOfPoints()) +
    " points and " + std::to_string(input->GetNumberOfLines()) +
    " lines, but neither a polygon nor lines that close. Close the outline, or merge its equal "
    "points with Clean.");
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
bool vtkHybridTreePolygonFromOutline::ReadOtherInputs()
{
  this->Input = this->GetWholeInput(0);
  if (!this->Input)
  {
    throw hybridtree::InvalidGeometry("There is no data. Check the filter it comes from.");
  }
  return std::exchange(this->InputTime, this->Input->GetMTime()) != this->Input->GetMTime();
}

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreePolygonFromOutline::MakeSkeleton()
{
  return hybridtree::makePolygon(
    hybridtree::placesOf(outlineOf(this->Input), this->Input), this->LevelOfDetail);
}

//------------------------------------------------------------------------------
void vtkHybridTreePolygonFromOutline::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
}
