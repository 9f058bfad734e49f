// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeSpline.h"

#include "core/base/Error.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHybridTreeSpline);

//------------------------------------------------------------------------------
vtkHybridTreeSpline::vtkHybridTreeSpline()
{
  this->Points = { { -1.0, 0.0, 0.0 }, { -0.3, 0.5, 0.0 }, { 0.3, -0.5, 0.0 }, { 1.0, 0.0, 0.0 } };
  // The bends of the default curve leave room for this.
  this->SurfaceRadius = 0.15;
  this->InfluenceRadius = 0.3;
}

vtkHybridTreeSpline::~vtkHybridTreeSpline() = default;

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeSpline::MakeSkeleton()
{
  if (this->Kind != CATMULL_ROM && this->Kind != B_SPLINE)
  {
    throw hybridtree::InvalidParameter("Kind", this->Kind, "0 (Catmull-Rom) or 1 (B-spline)");
  }
  hybridtree::SplineCurve curve;
  for (const auto& point : this->Points)
  {
    curve.points.emplace_back(point[0], point[1], point[2]);
  }
  curve.kind =
    this->Kind == B_SPLINE ? hybridtree::SplineKind::BSpline : hybridtree::SplineKind::CatmullRom;
  curve.closed = this->Closed;
  curve = hybridtree::requireCurve(std::move(curve));
  return hybridtree::makeSpline(
    hybridtree::simplified(curve, hybridtree::detailTolerance(curve, this->LevelOfDetail)));
}

//------------------------------------------------------------------------------
void vtkHybridTreeSpline::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "Closed: " << this->Closed << "\n";
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
}
