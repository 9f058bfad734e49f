// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSurfaceOfRevolution.h"

#include "core/base/Error.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Validate.h"
#include "vtkHybridTreePaths.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <string>
#include <utility>

vtkStandardNewMacro(vtkHybridTreeSurfaceOfRevolution);

namespace
{

// What the first line goes on to draw, or else the first polygon.
hybridtree::Path drawnProfile(vtkPolyData* input)
{
  for (auto& paths : { hybridtree::pathsOf(input), hybridtree::polygonsOf(input) })
  {
    if (!paths.empty())
    {
      return paths.front();
    }
  }
  throw hybridtree::InvalidGeometry("The input has " + std::to_string(input->GetNumberOfPoints()) +
    " points, but neither lines nor a polygon, which make the profile. Take a slice, a polyline or "
    "a "
    "spline, or disconnect the input and give Points.");
}

} // namespace

//------------------------------------------------------------------------------
vtkHybridTreeSurfaceOfRevolution::vtkHybridTreeSurfaceOfRevolution()
{
  this->SetNumberOfInputPorts(1);
  this->Points = { { 0.6, 0.0, -1.0 }, { 0.9, 0.0, -0.4 }, { 0.4, 0.0, 0.4 }, { 0.5, 0.0, 1.0 } };
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeSurfaceOfRevolution::~vtkHybridTreeSurfaceOfRevolution() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeSurfaceOfRevolution::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  info->Set(TAKES_TREE(), 0); // the profile itself is wanted
  return filled;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeSurfaceOfRevolution::TakesNodes(int)
{
  return false;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeSurfaceOfRevolution::ReadOtherInputs()
{
  this->Input = this->GetWholeInput(0);
  const vtkMTimeType time = this->Input ? this->Input->GetMTime() : 0;
  return std::exchange(this->InputTime, time) != time;
}

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeSurfaceOfRevolution::MakeSkeleton()
{
  using hybridtree::Vec3;
  if (this->Kind < CATMULL_ROM || this->Kind > POLYLINE)
  {
    throw hybridtree::InvalidParameter(
      "Kind", this->Kind, "0 (Catmull-Rom), 1 (B-spline) or 2 (polyline)");
  }
  const Vec3 origin = hybridtree::requireFinite("Origin", Vec3(this->Origin));
  const Vec3 axis = hybridtree::requireDirection("Axis", Vec3(this->Axis));
  hybridtree::SplineCurve curve;
  curve.kind = static_cast<hybridtree::SplineKind>(this->Kind);
  curve.closed = this->Closed;
  if (this->Input)
  {
    const hybridtree::Path path = drawnProfile(this->Input);
    curve.points = hybridtree::placesOf(path, this->Input);
    curve.closed = curve.closed || path.closed;
  }
  else
  {
    for (const auto& point : this->Points)
    {
      curve.points.emplace_back(point.data());
    }
  }
  for (Vec3& point : curve.points)
  {
    const Vec3 offset = point - origin;
    const double height = axis.dot(offset);
    point = Vec3((offset - height * axis).norm(), height, 0.0);
  }
  curve = hybridtree::requireCurve(std::move(curve));
  curve = hybridtree::simplified(curve, hybridtree::detailTolerance(curve, this->LevelOfDetail));
  return std::make_shared<hybridtree::RevolutionSkeleton>(
    hybridtree::RevolutionShape{ origin, axis, std::move(curve), this->Solid });
}

//------------------------------------------------------------------------------
void vtkHybridTreeSurfaceOfRevolution::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "Closed: " << this->Closed << "\n";
  os << indent << "Origin: (" << this->Origin[0] << ", " << this->Origin[1] << ", "
     << this->Origin[2] << ")\n";
  os << indent << "Axis: (" << this->Axis[0] << ", " << this->Axis[1] << ", " << this->Axis[2]
     << ")\n";
  os << indent << "Solid: " << this->Solid << "\n";
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
}
