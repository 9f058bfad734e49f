// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeCurveSkeletons.h"

#include "core/base/Error.h"
#include "core/nodes/CurveTree.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <utility>

vtkStandardNewMacro(vtkHybridTreeCurveSkeletons);

namespace
{

using hybridtree::SplineCurve;
using hybridtree::SplineKind;

constexpr double kAutomaticRadius = 0.03; // in longest sides of the bounds

double longestSide(const std::vector<SplineCurve>& curves)
{
  hybridtree::Box3 bounds;
  for (const SplineCurve& curve : curves)
  {
    for (const hybridtree::Vec3& point : curve.points)
    {
      bounds.extend(point);
    }
  }
  return bounds.isEmpty() ? 0.0 : bounds.sizes().maxCoeff();
}

/// Reads the cells of one polydata as curves.
class CurveReader
{
public:
  CurveReader(vtkPolyData* input, const std::string& radiusArray, SplineKind kind)
    : Input(input), Kind(kind)
  {
    if (radiusArray.empty() || radiusArray == "None")
    {
      return;
    }
    this->Radius = input->GetPointData()->GetArray(radiusArray.c_str());
    if (!this->Radius || this->Radius->GetNumberOfComponents() != 1 ||
      this->Radius->GetNumberOfTuples() < input->GetNumberOfPoints())
    {
      throw hybridtree::InvalidParameter("RadiusArray", radiusArray,
        "a point array of one component of the input, with a value for each point, or \"None\"");
    }
  }

  std::vector<SplineCurve> Read() const
  {
    std::vector<SplineCurve> curves;
    this->ReadCells(this->Input->GetVerts(), true, curves);
    this->ReadCells(this->Input->GetLines(), false, curves);
    if (curves.empty())
    {
      throw hybridtree::InvalidGeometry("The input has " +
        std::to_string(this->Input->GetNumberOfPoints()) + " points and " +
        std::to_string(this->Input->GetNumberOfPolys()) +
        " polygons, but neither vertices nor lines, of which curve skeletons are made. Take its "
        "edges or feature edges, or give it vertices.");
    }
    return curves;
  }

private:
  void ReadCells(vtkCellArray* cells, bool vertices, std::vector<SplineCurve>& curves) const
  {
    const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size;
      const vtkIdType* ids;
      iterator->GetCurrentCell(size, ids);
      for (vtkIdType k = 0; vertices && k < size; ++k)
      {
        curves.push_back(this->MakeCurve(1, ids + k));
      }
      if (!vertices && size > 0)
      {
        curves.push_back(this->MakeCurve(size, ids));
      }
    }
  }

  SplineCurve MakeCurve(vtkIdType size, const vtkIdType* ids) const
  {
    SplineCurve curve;
    curve.kind = this->Kind;
    curve.closed = size > 2 && ids[0] == ids[size - 1];
    for (vtkIdType k = 0; k < (curve.closed ? size - 1 : size); ++k)
    {
      double point[3];
      this->Input->GetPoint(ids[k], point);
      curve.points.emplace_back(point);
      if (!curve.points.back().allFinite())
      {
        throw hybridtree::InvalidGeometry(
          "Point " + std::to_string(ids[k]) + " of the input is not finite. Remove or mend it.");
      }
      if (this->Radius)
      {
        curve.radii.push_back(this->RadiusOf(ids[k]));
      }
    }
    return curve;
  }

  double RadiusOf(vtkIdType id) const
  {
    const double radius = this->Radius->GetComponent(id, 0);
    if (!(std::isfinite(radius) && radius >= 0.0))
    {
      throw hybridtree::InvalidParameter(
        "Radius of point " + std::to_string(id) + " of the input", radius, "finite and >= 0");
    }
    return radius;
  }

  vtkPolyData* Input;
  vtkDataArray* Radius = nullptr;
  SplineKind Kind;
};

} // namespace

//------------------------------------------------------------------------------
vtkHybridTreeCurveSkeletons::vtkHybridTreeCurveSkeletons()
{
  this->SetNumberOfInputPorts(1);
  this->SurfaceRadius = 0.0;
  this->InfluenceRadius = 0.0;
}

vtkHybridTreeCurveSkeletons::~vtkHybridTreeCurveSkeletons() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeCurveSkeletons::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  info->Set(TAKES_TREE(), 0); // the lines themselves are wanted
  return filled;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeCurveSkeletons::TakesNodes(int)
{
  return false;
}

//------------------------------------------------------------------------------
bool vtkHybridTreeCurveSkeletons::ReadOtherInputs()
{
  this->Input = this->GetWholeInput(0);
  if (!this->Input)
  {
    throw hybridtree::InvalidGeometry("There is no data. Check the filter it comes from.");
  }
  return std::exchange(this->InputTime, this->Input->GetMTime()) != this->Input->GetMTime();
}

//------------------------------------------------------------------------------
vtkHybridTreeCurveSkeletons::NodePtr vtkHybridTreeCurveSkeletons::MakeNode(const Operands&)
{
  if (this->As != SEGMENTS && this->As != SPLINE)
  {
    throw hybridtree::InvalidParameter("As", this->As, "0 (segments) or 1 (spline)");
  }
  if (this->Blend != WITHIN_CURVE && this->Blend != ACROSS_ALL)
  {
    throw hybridtree::InvalidParameter(
      "Blend", this->Blend, "0 (within a curve) or 1 (across all)");
  }
  const auto kind = this->As == SPLINE ? SplineKind::CatmullRom : SplineKind::Polyline;
  const CurveReader reader(this->Input, this->RadiusArray, kind);
  const std::vector<SplineCurve> curves = reader.Read();
  return hybridtree::makeCurveTree(
    curves, { this->FittedPotential(curves), this->Blend == ACROSS_ALL, this->LevelOfDetail });
}

//------------------------------------------------------------------------------
hybridtree::Potential vtkHybridTreeCurveSkeletons::FittedPotential(
  const std::vector<SplineCurve>& curves) const
{
  double surface = this->SurfaceRadius;
  if (surface == 0.0)
  {
    surface = kAutomaticRadius * longestSide(curves);
    if (!(surface > 0.0) && !this->UsesMaximumField())
    {
      throw hybridtree::InvalidParameter("SurfaceRadius", 0.0,
        "greater than 0 for an input of a single point, which has no size of its own");
    }
    surface =
      this->InfluenceRadius > 0.0 ? std::min(surface, 0.5 * this->InfluenceRadius) : surface;
  }
  if (!(surface >= 0.0 && std::isfinite(surface)))
  {
    throw hybridtree::InvalidParameter("SurfaceRadius", surface,
      "a finite length > 0, or 0 for 3 % of the longest side of the bounds");
  }
  return this->GetPotential(
    surface, this->InfluenceRadius == 0.0 ? 2.0 * surface : this->InfluenceRadius);
}

//------------------------------------------------------------------------------
std::shared_ptr<const hybridtree::Skeleton> vtkHybridTreeCurveSkeletons::MakeSkeleton()
{
  return nullptr; // there are many
}

//------------------------------------------------------------------------------
void vtkHybridTreeCurveSkeletons::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RadiusArray: " << this->RadiusArray << "\n";
  os << indent << "As: " << this->As << "\n";
  os << indent << "Blend: " << this->Blend << "\n";
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
}
