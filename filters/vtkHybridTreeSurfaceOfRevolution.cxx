// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSurfaceOfRevolution.h"

#include "core/base/Error.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Validate.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeSurfaceOfRevolution);

//------------------------------------------------------------------------------
vtkHybridTreeSurfaceOfRevolution::vtkHybridTreeSurfaceOfRevolution()
{
  this->Points = { { 0.6, 0.0, -1.0 }, { 0.9, 0.0, -0.4 }, { 0.4, 0.0, 0.4 }, { 0.5, 0.0, 1.0 } };
  this->SurfaceRadius = 0.1;
  this->InfluenceRadius = 0.5;
}

vtkHybridTreeSurfaceOfRevolution::~vtkHybridTreeSurfaceOfRevolution() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeSurfaceOfRevolution::MakeSkeleton()
{
  using hybridtree::Vec3;
  if (this->Kind < CATMULL_ROM || this->Kind > POLYLINE)
  {
    throw hybridtree::InvalidParameter(
      "Kind", this->Kind, "0 (Catmull-Rom), 1 (B-spline) or 2 (polyline)");
  }
  const Vec3 origin(this->Origin);
  const Vec3 axis = hybridtree::requireDirection("Axis", Vec3(this->Axis));
  hybridtree::SplineCurve curve;
  for (const auto& point : this->Points)
  {
    const Vec3 offset = Vec3(point.data()) - origin;
    const double height = axis.dot(offset);
    curve.points.emplace_back((offset - height * axis).norm(), height, 0.0);
  }
  curve.kind = static_cast<hybridtree::SplineKind>(this->Kind);
  curve.closed = this->Closed;
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
