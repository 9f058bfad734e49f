// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeBarr.h"

#include "core/base/Error.h"
#include "core/nodes/Barr.h"
#include "vtkHybridTreeBounds.h"

#include <algorithm>

//------------------------------------------------------------------------------
vtkHybridTreeBarr::vtkHybridTreeBarr() = default;
vtkHybridTreeBarr::~vtkHybridTreeBarr() = default;

//------------------------------------------------------------------------------
hybridtree::BarrFrame vtkHybridTreeBarr::GetFrame(const hybridtree::Node& input) const
{
  using hybridtree::Vec3;
  const hybridtree::Box3 box = hybridtree::boundsToFit(input);
  hybridtree::BarrFrame frame;
  frame.origin = Vec3(this->Origin);
  if (this->FitToInput && frame.origin.isZero(0.0))
  {
    frame.origin = box.center();
  }
  frame.axis = Vec3(this->Axis);
  frame.normal = Vec3(this->Normal);
  frame.begin = this->Range[0];
  frame.end = this->Range[1];
  if (frame.begin == frame.end && frame.axis.norm() > 0.0)
  {
    // The box reaches as far along a direction as the sum of its half edges' shares in it.
    const Vec3 axis = frame.axis.normalized();
    const double middle = axis.dot(box.center() - frame.origin);
    const double half = axis.cwiseAbs().dot(box.sizes()) / 2.0;
    frame.begin = middle - half;
    frame.end = middle + half;
    if (!(frame.begin < frame.end) && frame.origin.allFinite())
    {
      throw hybridtree::InvalidParameter("Range", "of no length by itself",
        "given: the input has no extent along the axis, or Origin is too far from it");
    }
  }
  return frame;
}

//------------------------------------------------------------------------------
hybridtree::BarrFrame vtkHybridTreeBarr::GetFrameAroundAxis(const hybridtree::Node& input) const
{
  hybridtree::BarrFrame frame = this->GetFrame(input);
  const double lengths = frame.axis.norm() * frame.normal.norm();
  if (frame.axis.norm() > 0.0 && frame.axis.cross(frame.normal).norm() <= 1e-6 * lengths)
  {
    frame.normal = frame.axis.unitOrthogonal();
  }
  return frame;
}

//------------------------------------------------------------------------------
void vtkHybridTreeBarr::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Origin: (" << this->Origin[0] << ", " << this->Origin[1] << ", "
     << this->Origin[2] << ")\n";
  os << indent << "Axis: (" << this->Axis[0] << ", " << this->Axis[1] << ", " << this->Axis[2]
     << ")\n";
  os << indent << "Normal: (" << this->Normal[0] << ", " << this->Normal[1] << ", "
     << this->Normal[2] << ")\n";
  os << indent << "Range: (" << this->Range[0] << ", " << this->Range[1] << ")\n";
  os << indent << "FitToInput: " << this->FitToInput << "\n";
}
